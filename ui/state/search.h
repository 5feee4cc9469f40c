/* Finding names by parts of them. */
#ifndef ANG_UI_SEARCH_H
#define ANG_UI_SEARCH_H

/* How well `query` finds `text`: -1 where one of its words does not occur in it, else the less the better: a word that
 * begins the text counts 0, one that begins a word 1, one within a word 2. Case of ASCII letters does not matter. An
 * empty query finds everything alike. */
int ang_search_rank(const char *query, const char *text);

#endif
