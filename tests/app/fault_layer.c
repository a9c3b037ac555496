/* A disk that fails at the moment it is told to, and a machine that stops there: loaded into chute or ffmpeg by tests, with
   LD_PRELOAD. Counts the calls that change files (open to write, write, truncate, rename, link, unlink, mkdir, flush) below
   the working folder, and at the one of that number
   CHUTE_FAULT_HOW=kill    ends the process at once; a write is done by half
   CHUTE_FAULT_HOW=ENOSPC  the disk is full from now on
   CHUTE_FAULT_HOW=EIO     this call fails
   CHUTE_FAULT_AT=N        which call, from 1 on; 0: none
   CHUTE_FAULT_PROGRAM     only in a program of this name
   CHUTE_FAULT_OLD=1       the disk knows no rename but the plain one, as network disks do
   CHUTE_FAULT_COUNT=FILE  appends a line for each call: how many there are, and which. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static long count, at = -1;
static int full;

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static void begin(void) {
  if (at >= 0) return;
  const char *given = getenv("CHUTE_FAULT_AT"), *program = getenv("CHUTE_FAULT_PROGRAM");
  at = given && program && !strcmp(program, program_invocation_short_name) ? atol(given) : LONG_MAX;
}

static void note(const char* call, const char* path) {
  const char* file = getenv("CHUTE_FAULT_COUNT");
  if (!file || at == LONG_MAX) return;
  char line[400];
  const int size = snprintf(line, sizeof line, "%ld %s %.300s\n", count, call, path ? path : "");
  const int out = (int)syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_APPEND, 0666);
  syscall(SYS_write, out, line, (size_t)size);
  syscall(SYS_close, out);
}

static int is_inside(const char* path) {
  char folder[PATH_MAX];
  if (path[0] != '/') return 1;
  return getcwd(folder, sizeof folder) && !strncmp(path, folder, strlen(folder));
}

/* 0: go on; else the error that the call has. */
static int fault(const char* call, const char* path) {
  begin();
  if (at == LONG_MAX || !is_inside(path)) return 0;
  const int now = ++count == at;
  note(call, path);
  const char* how = getenv("CHUTE_FAULT_HOW");
  if (!how) return 0;
  if (now && !strcmp(how, "kill")) return -1;
  if (now && !strcmp(how, "EIO")) return EIO;
  if (now && !strcmp(how, "ENOSPC")) full = 1;
  /* a full disk still removes and renames */
  return full && (now || !strcmp(call, "write") || !strcmp(call, "open") || !strcmp(call, "mkdir")) ? ENOSPC
                                                                                                    : 0;
}

static void end(void) { syscall(SYS_kill, getpid(), SIGKILL); }

#define STOP_IF_FAULT(call, path)      \
  const int error = fault(call, path); \
  if (error < 0) end();                \
  if (error > 0) return errno = error, -1;

static const char* path_of(int file, char* into) {
  char link[64];
  struct stat facts;
  if (fstat(file, &facts) != 0 || !(S_ISREG(facts.st_mode) || S_ISDIR(facts.st_mode))) return NULL;
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t size = readlink(link, into, PATH_MAX - 1);
  if (size < 0) return NULL;
  into[size] = 0;
  return into;
}

/* Clang-format would make one line a call of these. */
/* clang-format off */
#define OPEN(name, arguments, path, flags, call)                  \
  int name arguments {                                            \
    mode_t mode = 0;                                              \
    if (flags & (O_CREAT | O_TMPFILE)) {                          \
      va_list list;                                               \
      va_start(list, flags);                                      \
      mode = va_arg(list, mode_t);                                \
      va_end(list);                                               \
    }                                                             \
    if (flags & (O_CREAT | O_WRONLY | O_RDWR)) {                  \
      STOP_IF_FAULT("open", path)                                 \
    }                                                             \
    return call;                                                  \
  }
OPEN(open, (const char* path, int flags, ...), path, flags, REAL(open)(path, flags, mode))
OPEN(open64, (const char* path, int flags, ...), path, flags, REAL(open64)(path, flags, mode))
OPEN(openat, (int folder, const char* path, int flags, ...), path, flags, REAL(openat)(folder, path, flags, mode))
OPEN(openat64, (int folder, const char* path, int flags, ...), path, flags, REAL(openat64)(folder, path, flags, mode))

ssize_t write(int file, const void* bytes, size_t size) {
  char path[PATH_MAX];
  if (path_of(file, path)) {
    const int error = fault("write", path);
    if (error < 0) {
      REAL(write)(file, bytes, size / 2);
      end();
    }
    if (error > 0) return errno = error, -1;
  }
  return REAL(write)(file, bytes, size);
}

#define ON_FILE(result, name, arguments, call)                    \
  result name arguments {                                         \
    char path[PATH_MAX];                                          \
    if (path_of(file, path)) {                                    \
      STOP_IF_FAULT(#name, path)                                  \
    }                                                             \
    return call;                                                  \
  }
ON_FILE(int, fsync, (int file), REAL(fsync)(file))
ON_FILE(int, fdatasync, (int file), REAL(fdatasync)(file))
ON_FILE(int, ftruncate, (int file, off_t size), REAL(ftruncate)(file, size))
ON_FILE(ssize_t, pwrite, (int file, const void* bytes, size_t size, off_t to), REAL(pwrite)(file, bytes, size, to))

#define ON_PATH(name, arguments, path, call)                      \
  int name arguments {                                            \
    STOP_IF_FAULT(#name, path)                                    \
    return call;                                                  \
  }
ON_PATH(rename, (const char* from, const char* to), from, REAL(rename)(from, to))
ON_PATH(renameat2, (int f, const char* from, int t, const char* to, unsigned flags), from,
        getenv("CHUTE_FAULT_OLD") ? (errno = EINVAL, -1) : REAL(renameat2)(f, from, t, to, flags))
ON_PATH(link, (const char* from, const char* to), from, REAL(link)(from, to))
ON_PATH(unlink, (const char* path), path, REAL(unlink)(path))
ON_PATH(unlinkat, (int folder, const char* path, int flags), path, REAL(unlinkat)(folder, path, flags))
ON_PATH(remove, (const char* path), path, REAL(remove)(path))
ON_PATH(rmdir, (const char* path), path, REAL(rmdir)(path))
ON_PATH(mkdir, (const char* path, mode_t mode), path, REAL(mkdir)(path, mode))
/* clang-format on */
