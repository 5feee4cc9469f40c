/* Everything that can be done by menu or key. */
#ifndef ANG_UI_ACTIONS_H
#define ANG_UI_ACTIONS_H

#include <stdbool.h>

typedef struct ang_viewer ang_viewer;

/* Something that can be done by menu or key. */
typedef struct ang_action {
    const char *menu;
    const char *name;
    const char *help; /* what the name does not say; NULL: nothing */
    int key;          /* ang_key; 0: none */
    unsigned modifiers;
    void (*run)(ang_viewer *viewer, int argument);
    int argument;
    bool apart;                                              /* from what stands before it in the menu */
    bool (*enabled)(const ang_viewer *viewer);               /* NULL: always */
    bool (*checked)(const ang_viewer *viewer, int argument); /* NULL: no tick */
} ang_action;

/* All of them, those of a menu together. */
const ang_action *ang_actions(int *count);
bool ang_action_enabled(const ang_viewer *viewer, const ang_action *action);
/* "Ctrl+S" of an action; empty where it has no key. */
const char *ang_action_shortcut(const ang_action *action, char text[32]);

#endif
