/* Many viewers in one light process, and the cheapest server there could be.

   viewers watch HOST PORT VIEWERS SECONDS SETTLE LEAD FRAMES SUBPROTOCOL PATH...
     opens so many WebSockets over the paths in turn, from several addresses of 127.0.0.0/8 so that ports
     suffice; says `joined`, lets SETTLE seconds pass, says `measuring`, watches for SECONDS, and prints a line
     of JSON. FRAMES is how many frames a binary message has; 0 for what is no frame of ours (docs/protocol.md),
     -1 where messages of text count as well.
     A frame is late by what it comes after LEAD seconds before it is due. It is looked for what came every half
     millisecond, and not waited for: to wake who waits costs the sender up to twice what sending does, more or
     less as this process keeps up, and viewers elsewhere are not woken by the server.
   viewers fetch HOST PORT VIEWERS SECONDS SETTLE BLOCKS PATH...
     has so many connections, over the paths in turn, each of which asks for a packed block once a second, PATH/0 to
     PATH/BLOCKS-1 as time goes on, the viewers one after another at even distances; says `joined` and `measuring`
     as above, and prints a line of JSON. A request lasts from when it was due to its answer's last byte.
   viewers send VIEWERS BYTES RATE
     says `port N`, takes so many viewers in, and sends each a binary message of so many bytes, RATE times a
     second by absolute deadlines, with send() alone: what the kernel asks for a message. RATE 0 sends as fast
     as it is read, which is what the viewers can take at most. */
#define _GNU_SOURCE
#include <arpa/inet.h>
#include <errno.h>
#include <math.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

static const struct timespec LOOKING = {.tv_nsec = 500000};
enum {
    VIEWERS_AN_ADDRESS = 4000,
    JOINING_AT_ONCE = 32,
    EVENTS = 512,
    READ_BYTES = 1 << 18,
    FRAME_HEAD = 24,
    TEXT = 1,
    BINARY = 2,
    CLOSE = 8,
    PING = 9,
};
static const double BUCKET_S = 5e-5; /* how finely times are told apart */
enum { BUCKETS = 60000 };            /* 3 s */

static void fail(const char *format, ...) {
    va_list values;
    va_start(values, format);
    vfprintf(stderr, format, values);
    va_end(values);
    fputc('\n', stderr);
    exit(1);
}

static double now_s(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

static double cpu_s(void) {
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    return (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec) * 1e-6;
}

static void raise_file_limit(void) {
    struct rlimit limit;
    getrlimit(RLIMIT_NOFILE, &limit);
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_NOFILE, &limit);
}

/* Times, seconds, counted in buckets. */
typedef struct {
    uint64_t buckets[BUCKETS], count;
    double max;
} Times;

static void add(Times *times, double value) {
    int64_t bucket = value > 0 ? (int64_t)(value / BUCKET_S) : 0;
    times->buckets[bucket < BUCKETS ? bucket : BUCKETS - 1]++;
    if (!times->count++ || value > times->max) times->max = value;
}

static double percentile(const Times *times, double share) {
    uint64_t below = 0;
    for (int64_t bucket = 0; bucket < BUCKETS; bucket++) {
        below += times->buckets[bucket];
        if ((double)below >= share * (double)times->count) return (double)(bucket + 1) * BUCKET_S;
    }
    return times->max;
}

static void print_times(const char *name, const Times *times) {
    printf("\"%s\": ", name);
    if (!times->count) {
        printf("null, ");
        return;
    }
    printf("{\"p50\": %.2f, \"p99\": %.2f, \"max\": %.2f}, ", percentile(times, 0.5) * 1e3,
           percentile(times, 0.99) * 1e3, times->max * 1e3);
}

typedef struct {
    int fd;
    bool joined;
    uint8_t matched;       /* bytes of the blank line that ends the answer's head */
    uint8_t head[10];      /* of the WebSocket frame that is being read */
    uint8_t head_size;     /* how much of it is there */
    bool inside;           /* its head is whole */
    uint64_t length, left; /* of its payload */
    uint8_t first[125];    /* its payload's first bytes */
    uint8_t first_size;
    char answer[13];
    uint8_t answer_size;
    double arrived;        /* when the last binary message came, 0 before the first */
    uint32_t index;        /* the frame's that it began with */
    uint64_t messages;
} Viewer;

static struct {
    const char *host, *subprotocol;
    char **paths;
    int port, path_count, epoll, viewers, frames;
    double lead;
} given;

static struct {
    Times interval, late;
    uint64_t messages, bytes, texts, text_bytes, pings, lost, closed;
} seen;

/* A connection that epoll tells of by `whose`. */
static int connected(int number, void *whose) {
    int on = 1, fd = socket(AF_INET, SOCK_STREAM, 0);
    if (fd < 0) fail("no more sockets after %d: %s", number, strerror(errno));
    setsockopt(fd, IPPROTO_IP, IP_BIND_ADDRESS_NO_PORT, &on, sizeof on);
    struct sockaddr_in from = {.sin_family = AF_INET};
    from.sin_addr.s_addr = htonl(INADDR_LOOPBACK + (uint32_t)(number / VIEWERS_AN_ADDRESS));
    if (bind(fd, (struct sockaddr *)&from, sizeof from)) fail("bind: %s", strerror(errno));
    struct sockaddr_in to = {.sin_family = AF_INET, .sin_port = htons((uint16_t)given.port)};
    inet_pton(AF_INET, given.host, &to.sin_addr);
    if (connect(fd, (struct sockaddr *)&to, sizeof to)) fail("connect: %s", strerror(errno));
    struct epoll_event event = {.events = EPOLLIN, .data.ptr = whose};
    if (epoll_ctl(given.epoll, EPOLL_CTL_ADD, fd, &event)) fail("epoll: %s", strerror(errno));
    return fd;
}

static void begin(Viewer *viewer, int number) {
    viewer->fd = connected(number, viewer);
    char request[1024];
    int size = snprintf(request, sizeof request,
                        "GET %s HTTP/1.1\r\nHost: %s:%d\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                        "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                        "Sec-WebSocket-Protocol: %s\r\n\r\n",
                        given.paths[number % given.path_count], given.host, given.port, given.subprotocol);
    if (size >= (int)sizeof request) fail("the path is too long");
    if (send(viewer->fd, request, (size_t)size, 0) != size) fail("send: %s", strerror(errno));
}

static void pong(Viewer *viewer) {
    /* Masked by zeros: the payload stays as it is. */
    uint8_t answer[6 + 125] = {0x8a, (uint8_t)(0x80 | viewer->first_size), 0, 0, 0, 0};
    memcpy(answer + 6, viewer->first, viewer->first_size);
    if (send(viewer->fd, answer, 6u + viewer->first_size, MSG_DONTWAIT) < 0) fail("pong: %s", strerror(errno));
    seen.pings++;
}

static void counted(Viewer *viewer, double arrived) {
    uint32_t index = 0;
    if (given.frames > 0) {
        uint16_t flags;
        double due;
        memcpy(&flags, viewer->first + 2, sizeof flags);
        memcpy(&index, viewer->first + 4, sizeof index);
        memcpy(&due, viewer->first + 16, sizeof due);
        if (viewer->first_size < FRAME_HEAD || !(flags & 1)) return; /* the music stands still */
        add(&seen.late, arrived - (due - given.lead));
        if (viewer->arrived > 0 && index != viewer->index + (uint32_t)given.frames) seen.lost++;
    }
    if (viewer->arrived > 0) add(&seen.interval, arrived - viewer->arrived);
    viewer->arrived = arrived;
    viewer->index = index;
    viewer->messages++;
    seen.messages++;
    seen.bytes += viewer->length;
}

static void message(Viewer *viewer, double arrived) {
    int kind = viewer->head[0] & 15;
    if (kind == BINARY || (kind == TEXT && given.frames < 0)) counted(viewer, arrived);
    else if (kind == PING) pong(viewer);
    else if (kind != CLOSE) {
        seen.texts++;
        seen.text_bytes += viewer->length;
    }
}

/* Read what came into one viewer; returns whether it joined by that. */
static bool take(Viewer *viewer, const uint8_t *data, size_t size, double arrived) {
    bool joins = false;
    for (size_t at = 0; at < size;) {
        if (!viewer->joined) {
            if (viewer->answer_size < 12) viewer->answer[viewer->answer_size++] = (char)data[at];
            viewer->matched = data[at] == "\r\n\r\n"[viewer->matched] ? viewer->matched + 1 : data[at] == '\r';
            at++;
            if (viewer->matched == 4) {
                if (strcmp(viewer->answer, "HTTP/1.1 101")) fail("a viewer was refused: %s", viewer->answer);
                viewer->joined = joins = true;
            }
            continue;
        }
        if (!viewer->inside) {
            viewer->head[viewer->head_size++] = data[at++];
            int length = viewer->head_size < 2 ? -1 : viewer->head[1] & 127;
            int bytes = length == 126 ? 2 : length == 127 ? 8 : 0;
            if (length < 0 || viewer->head_size < 2 + bytes) continue;
            viewer->length = bytes ? 0 : (uint64_t)length;
            for (int i = 0; i < bytes; i++) viewer->length = viewer->length << 8 | viewer->head[2 + i];
            viewer->left = viewer->length;
            viewer->inside = true;
            viewer->first_size = 0;
        }
        size_t here = size - at < viewer->left ? size - at : (size_t)viewer->left;
        size_t room = sizeof viewer->first - viewer->first_size, kept = here < room ? here : room;
        memcpy(viewer->first + viewer->first_size, data + at, kept);
        viewer->first_size += (uint8_t)kept;
        viewer->left -= here;
        at += here;
        if (!viewer->left) {
            message(viewer, arrived);
            viewer->inside = false;
            viewer->head_size = 0;
        }
    }
    return joins;
}

/* Read whatever comes until a time, or until so many have joined; returns how many joined. */
static int read_until(double until, int awaited) {
    static uint8_t data[READ_BYTES];
    struct epoll_event events[EVENTS];
    int joined = 0;
    for (double now = now_s(); now < until && (!awaited || joined < awaited); now = now_s()) {
        int ready = epoll_wait(given.epoll, events, EVENTS, 0);
        if (!ready) nanosleep(&LOOKING, NULL);
        for (int i = 0; i < ready; i++) {
            Viewer *viewer = events[i].data.ptr;
            ssize_t size = recv(viewer->fd, data, sizeof data, MSG_DONTWAIT);
            if (size > 0) joined += take(viewer, data, (size_t)size, now_s());
            else if (size == 0 || errno != EAGAIN) {
                if (!viewer->joined) fail("a viewer was closed before it could join");
                close(viewer->fd);
                seen.closed++;
            }
        }
    }
    return joined;
}

static void watch(double seconds, double settle) {
    Viewer *viewers = calloc((size_t)given.viewers, sizeof *viewers);
    given.epoll = epoll_create1(0);
    for (int begun = 0, joined = 0; joined < given.viewers;) {
        while (begun < given.viewers && begun - joined < JOINING_AT_ONCE) {
            begin(&viewers[begun], begun);
            begun++;
        }
        int more = read_until(now_s() + 30, 1);
        if (!more) fail("only %d viewers could join", joined);
        joined += more;
    }
    printf("joined\n");
    read_until(now_s() + settle, 0);
    memset(&seen, 0, sizeof seen);
    for (int i = 0; i < given.viewers; i++) viewers[i].messages = 0;
    double begun = now_s(), used = cpu_s();
    printf("measuring\n");
    read_until(begun + seconds, 0);
    used = cpu_s() - used;
    double lasted = now_s() - begun;
    uint64_t fewest = UINT64_MAX;
    for (int i = 0; i < given.viewers; i++)
        if (viewers[i].messages < fewest) fewest = viewers[i].messages;
    printf("{\"viewers\": %d, \"seconds\": %.3f, \"messages\": %lu, \"bytes\": %lu, \"fewest_a_second\": %.2f, ",
           given.viewers, lasted, seen.messages, seen.bytes, (double)fewest / lasted);
    print_times("interval", &seen.interval);
    print_times("late", &seen.late);
    printf("\"texts\": %lu, \"text_bytes\": %lu, \"pings\": %lu, \"lost\": %lu, \"closed\": %lu, \"cpu\": %.4f}\n",
           seen.texts, seen.text_bytes, seen.pings, seen.lost, seen.closed, used / lasted);
}

/* Asking for blocks */

typedef struct {
    int fd;
    bool asked;
    double due;
    char head[1024]; /* of the answer */
    size_t head_size;
    int64_t left;    /* of its body; -1 while its head is not whole */
} Fetcher;

static struct {
    Times lasted;
    uint64_t answers, bytes, other, behind;
} fetched;

static void ask(Fetcher *fetcher, int number, int block, double due) {
    char request[1024];
    int size = snprintf(request, sizeof request, "GET %s/%d HTTP/1.1\r\nHost: %s:%d\r\n\r\n",
                        given.paths[number % given.path_count], block, given.host, given.port);
    if (send(fetcher->fd, request, (size_t)size, MSG_DONTWAIT) != size) fail("send: %s", strerror(errno));
    fetcher->asked = true;
    fetcher->due = due;
    fetcher->head_size = 0;
    fetcher->left = -1;
}

static void take_answer(Fetcher *fetcher, const char *data, size_t size) {
    size_t at = 0;
    if (fetcher->left < 0) {
        while (at < size && fetcher->left < 0) {
            if (fetcher->head_size == sizeof fetcher->head - 1) fail("an answer's head is too long");
            fetcher->head[fetcher->head_size++] = data[at++];
            fetcher->head[fetcher->head_size] = 0;
            if (fetcher->head_size < 4 || strcmp(fetcher->head + fetcher->head_size - 4, "\r\n\r\n")) continue;
            const char *length = strcasestr(fetcher->head, "\r\ncontent-length:");
            if (!length) fail("an answer has no length: %s", fetcher->head);
            fetcher->left = atoll(length + 17);
            if (strncmp(fetcher->head, "HTTP/1.1 200", 12)) fetched.other++;
            fetched.bytes += (uint64_t)fetcher->left;
        }
    }
    fetcher->left -= (int64_t)(size - at);
    if (fetcher->left == 0) {
        fetched.answers++;
        add(&fetched.lasted, now_s() - fetcher->due);
        fetcher->asked = false;
    }
}

/* Ask and take answers until a time; the viewers take turns from `begun` on. */
static void fetch_until(Fetcher *fetchers, double begun, double until, int blocks, uint64_t *turn) {
    static char data[READ_BYTES];
    struct epoll_event events[EVENTS];
    for (double now = now_s(); now < until; now = now_s()) {
        for (double due; (due = begun + (double)*turn / given.viewers) <= now; ++*turn) {
            int number = (int)(*turn % (uint64_t)given.viewers);
            if (fetchers[number].asked) fetched.behind++;
            else ask(&fetchers[number], number, (int)(due - begun) % blocks, due);
        }
        int ready = epoll_wait(given.epoll, events, EVENTS, 0);
        if (!ready) nanosleep(&LOOKING, NULL);
        for (int i = 0; i < ready; i++) {
            Fetcher *fetcher = events[i].data.ptr;
            ssize_t size = recv(fetcher->fd, data, sizeof data, MSG_DONTWAIT);
            if (size > 0) take_answer(fetcher, data, (size_t)size);
            else if (size == 0 || errno != EAGAIN) fail("a connection was closed");
        }
    }
}

static void fetch(double seconds, double settle, int blocks) {
    Fetcher *fetchers = calloc((size_t)given.viewers, sizeof *fetchers);
    uint64_t turn = 0;
    given.epoll = epoll_create1(0);
    for (int i = 0; i < given.viewers; i++) fetchers[i].fd = connected(i, &fetchers[i]);
    printf("joined\n");
    double begun = now_s();
    fetch_until(fetchers, begun, begun + settle, blocks, &turn);
    memset(&fetched, 0, sizeof fetched);
    double used = cpu_s(), measured = now_s();
    printf("measuring\n");
    fetch_until(fetchers, begun, measured + seconds, blocks, &turn);
    printf("{\"viewers\": %d, \"seconds\": %.3f, \"answers\": %lu, \"bytes\": %lu, ", given.viewers,
           now_s() - measured, fetched.answers, fetched.bytes);
    print_times("lasted", &fetched.lasted);
    printf("\"other\": %lu, \"behind\": %lu, \"cpu\": %.4f}\n", fetched.other, fetched.behind,
           (cpu_s() - used) / (now_s() - measured));
}

static void send_all(int viewers, size_t bytes, double rate) {
    int on = 1, *fds = calloc((size_t)viewers, sizeof *fds), listening = socket(AF_INET, SOCK_STREAM, 0);
    struct sockaddr_in address = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    socklen_t address_size = sizeof address;
    if (bind(listening, (struct sockaddr *)&address, sizeof address) || listen(listening, 1024))
        fail("listen: %s", strerror(errno));
    getsockname(listening, (struct sockaddr *)&address, &address_size);
    printf("port %d\n", ntohs(address.sin_port));
    for (int i = 0; i < viewers; i++) {
        static const char accepted[] =
            "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            "Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r\n\r\n";
        char request[2048] = "";
        fds[i] = accept(listening, NULL, NULL);
        if (fds[i] < 0) fail("accept: %s", strerror(errno));
        for (size_t got = 0; !strstr(request, "\r\n\r\n");) {
            ssize_t size = recv(fds[i], request + got, sizeof request - 1 - got, 0);
            if (size <= 0) fail("no request came");
            got += (size_t)size;
        }
        setsockopt(fds[i], IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        send(fds[i], accepted, sizeof accepted - 1, 0);
    }
    uint8_t *frame = calloc(1, 10 + bytes);
    size_t head = bytes < 126 ? 2 : bytes < 65536 ? 4 : 10;
    frame[0] = 0x82;
    frame[1] = head == 2 ? (uint8_t)bytes : head == 4 ? 126 : 127;
    for (size_t i = 2; i < head; i++) frame[i] = (uint8_t)(bytes >> 8 * (head - 1 - i));
    if (bytes >= FRAME_HEAD) frame[head + 2] = 1; /* playing */
    double due = now_s();
    for (uint32_t index = 0;; index++) {
        if (bytes >= FRAME_HEAD) {
            memcpy(frame + head + 4, &index, sizeof index);
            memcpy(frame + head + 16, &due, sizeof due);
        }
        for (int i = 0; i < viewers; i++)
            if (send(fds[i], frame, head + bytes, 0) < 0) return; /* they have gone */
        if (rate > 0) due += 1 / rate;
        else due = now_s();
        struct timespec next = {.tv_sec = (time_t)due, .tv_nsec = (long)(fmod(due, 1.0) * 1e9)};
        clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, NULL);
    }
}

int main(int count, char **words) {
    setvbuf(stdout, NULL, _IOLBF, 0);
    signal(SIGPIPE, SIG_IGN);
    raise_file_limit();
    if (count > 9 && !strcmp(words[1], "watch")) {
        given.host = words[2];
        given.port = atoi(words[3]);
        given.viewers = atoi(words[4]);
        given.lead = atof(words[7]);
        given.frames = atoi(words[8]);
        given.subprotocol = words[9];
        given.paths = words + 10;
        given.path_count = count - 10;
        if (given.path_count < 1) fail("a path is needed");
        watch(atof(words[5]), atof(words[6]));
    } else if (count > 8 && !strcmp(words[1], "fetch")) {
        given.host = words[2];
        given.port = atoi(words[3]);
        given.viewers = atoi(words[4]);
        given.paths = words + 8;
        given.path_count = count - 8;
        fetch(atof(words[5]), atof(words[6]), atoi(words[7]));
    } else if (count == 5 && !strcmp(words[1], "send")) {
        send_all(atoi(words[2]), (size_t)atol(words[3]), atof(words[4]));
    } else {
        fail("see the head of viewers.c for how it is called");
    }
    return 0;
}
