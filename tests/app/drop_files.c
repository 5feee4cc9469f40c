/* Drops files on a window as a file manager does (XDND 5): drop_files /PATH... For tests of the viewer,
 * since xdotool cannot. The window is the one on the display that takes drops. Ends with 0 once it has taken them. */
#define _GNU_SOURCE
#include <X11/Xlib.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct drop {
    Display *display;
    Window source, target;
    Atom aware, enter, position, status, drop, finished, copy, selection, list;
    char *uris;
} drop;

static Atom atom(const drop *drop, const char *name) { return XInternAtom(drop->display, name, False); }

static bool takes_drops(const drop *drop, Window window) {
    Atom type;
    int format;
    unsigned long count, left;
    unsigned char *data = NULL;
    if (XGetWindowProperty(drop->display, window, drop->aware, 0, 1, False, AnyPropertyType, &type, &format, &count,
                           &left, &data) != Success)
        return false;
    if (data) XFree(data);
    return type != None;
}

static Window find(const drop *drop, Window window) {
    Window root, parent, *children = NULL, found = None;
    unsigned count = 0;
    if (takes_drops(drop, window)) return window;
    if (!XQueryTree(drop->display, window, &root, &parent, &children, &count)) return None;
    for (unsigned i = 0; i < count && found == None; i++) found = find(drop, children[i]);
    if (children) XFree(children);
    return found;
}

/* file:// URIs, a line each; all but what needs no escape as %XX (RFC 3986, RFC 2483). */
static char *write_uris(char *const *paths, int count) {
    size_t room = 1;
    for (int i = 0; i < count; i++) room += 3 * strlen(paths[i]) + 16;
    for (int i = 0; i < count; i++)
        if (paths[i][0] != '/') return NULL; /* a URI has no other paths, and GLFW reads beyond its end to find one */
    char *text = malloc(room), *to = text;
    for (int i = 0; i < count && text; i++) {
        to += sprintf(to, "file://");
        for (const unsigned char *p = (const unsigned char *)paths[i]; *p; p++) {
            bool plain =
                (*p >= 'a' && *p <= 'z') || (*p >= 'A' && *p <= 'Z') || (*p >= '0' && *p <= '9') || strchr("/-._~", *p);
            to += sprintf(to, plain ? "%c" : "%%%02X", *p);
        }
        to += sprintf(to, "\r\n");
    }
    return text;
}

static void send(const drop *drop, Atom type, long a, long b, long c, long d) {
    XEvent event = {.xclient = {.type = ClientMessage,
                                .display = drop->display,
                                .window = drop->target,
                                .message_type = type,
                                .format = 32,
                                .data.l = {(long)drop->source, a, b, c, d}}};
    XSendEvent(drop->display, drop->target, False, NoEventMask, &event);
    XFlush(drop->display);
}

/* Hands the URIs over. */
static void serve(const drop *drop, const XSelectionRequestEvent *request) {
    XChangeProperty(drop->display, request->requestor, request->property, request->target, 8, PropModeReplace,
                    (const unsigned char *)drop->uris, (int)strlen(drop->uris));
    XEvent reply = {.xselection = {.type = SelectionNotify,
                                   .display = drop->display,
                                   .requestor = request->requestor,
                                   .selection = request->selection,
                                   .target = request->target,
                                   .property = request->property,
                                   .time = request->time}};
    XSendEvent(drop->display, request->requestor, False, NoEventMask, &reply);
    XFlush(drop->display);
}

/* Waits for a message, serving the selection meanwhile; false after ten seconds. */
static bool wait_for(const drop *drop, Atom type, XClientMessageEvent *message) {
    struct timespec pause = {0, 5000000};
    for (int i = 0; i < 2000; i++) {
        while (XPending(drop->display)) {
            XEvent event;
            XNextEvent(drop->display, &event);
            if (event.type == SelectionRequest) serve(drop, &event.xselectionrequest);
            if (event.type == ClientMessage && event.xclient.message_type == type) {
                *message = event.xclient;
                return true;
            }
        }
        nanosleep(&pause, NULL);
    }
    return false;
}

static const char *carry_out(drop *drop) {
    XClientMessageEvent message;
    Window root = DefaultRootWindow(drop->display), child;
    int x = 0, y = 0;
    XWindowAttributes size;
    drop->source = XCreateSimpleWindow(drop->display, root, 0, 0, 1, 1, 0, 0, 0);
    drop->target = find(drop, root);
    if (drop->target == None) return "no window takes drops";
    XGetWindowAttributes(drop->display, drop->target, &size);
    XTranslateCoordinates(drop->display, drop->target, root, size.width / 2, size.height / 2, &x, &y, &child);
    XSetSelectionOwner(drop->display, drop->selection, drop->source, CurrentTime);
    send(drop, drop->enter, 5L << 24, (long)drop->list, None, None);
    send(drop, drop->position, 0, (long)x << 16 | y, CurrentTime, (long)drop->copy);
    if (!wait_for(drop, drop->status, &message)) return "the window does not answer";
    if (!(message.data.l[1] & 1)) return "the window does not want it";
    send(drop, drop->drop, 0, CurrentTime, 0, 0);
    return wait_for(drop, drop->finished, &message) ? NULL : "the window has not taken it";
}

int main(int count, char **arguments) {
    drop drop = {.display = XOpenDisplay(NULL)};
    if (!drop.display || count < 2) {
        fprintf(stderr, "drop_files: %s\n", count < 2 ? "give files" : "no display");
        return 2;
    }
    drop.aware = atom(&drop, "XdndAware");
    drop.enter = atom(&drop, "XdndEnter");
    drop.position = atom(&drop, "XdndPosition");
    drop.status = atom(&drop, "XdndStatus");
    drop.drop = atom(&drop, "XdndDrop");
    drop.finished = atom(&drop, "XdndFinished");
    drop.copy = atom(&drop, "XdndActionCopy");
    drop.selection = atom(&drop, "XdndSelection");
    drop.list = atom(&drop, "text/uri-list");
    drop.uris = write_uris(arguments + 1, count - 1);
    const char *failure = drop.uris ? carry_out(&drop) : "give whole paths";
    if (failure) fprintf(stderr, "drop_files: %s\n", failure);
    free(drop.uris);
    XCloseDisplay(drop.display);
    return failure != NULL;
}
