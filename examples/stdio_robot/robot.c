/* A robot in C99 without libraries: it gets the ball, carries it toward the goal, and shoots.
 *
 * Build it with `cc -std=c99 -O2 -o robot robot.c -lm`. Standard input: the briefing as a line of JSON, then each sight
 * as a line. Standard output: one command a line for each sight. docs/robot.md explains all of it.
 *
 * Instead of a JSON library there is one function, `find`, which follows a path of names from object to object.
 */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LONGEST_LINE 131072 /* bytes; a sight has at most 65536 */

static const double TOP_SPEED = 2.0;         /* m/s */
static const double SHOOTING_DISTANCE = 5.0; /* m from the goal line */
static const double AIM = 0.05;              /* rad; a kick waits until the robot points this well */

/* The end of the JSON string whose opening quote is at `at`. */
static const char *skip_string(const char *at) {
  for (at++; *at && *at != '"'; at++)
    if (*at == '\\' && at[1]) at++;
  return *at ? at + 1 : at;
}

/* The end of the JSON value at `at`: a string, a number, a word, or everything between two brackets. */
static const char *skip_value(const char *at) {
  int depth = 0;
  do {
    if (*at == '"') {
      at = skip_string(at);
      continue;
    }
    if (*at == '{' || *at == '[') depth++;
    if (*at == '}' || *at == ']') depth--;
    if (*at) at++;
  } while (*at && (depth > 0 || !strchr(",}]", *at)));
  return at;
}

/* The value of the field `name` of the JSON object at `at`; NULL if it has none, or if `at` is no object. */
static const char *field(const char *at, const char *name, size_t length) {
  if (!at || *at != '{') return NULL;
  at++;
  while (*at == '"') {
    const char *key = at + 1;
    at = skip_string(at); /* behind the closing quote, on the colon */
    bool is_it = (size_t)(at - 1 - key) == length && strncmp(key, name, length) == 0;
    if (is_it) return at + 1;
    at = skip_value(at + 1);
    if (*at == ',') at++;
  }
  return NULL;
}

/* The value at a path with dots, such as "game.phase", below the JSON object at `at`; NULL if there is none. */
static const char *find(const char *at, const char *path) {
  while (at && *path) {
    size_t length = strcspn(path, ".");
    at = field(at, path, length);
    path += length + (path[length] == '.');
  }
  return at;
}

static double number(const char *at, const char *path) {
  const char *found = find(at, path);
  return found ? strtod(found, NULL) : 0.0;
}

static bool is_true(const char *at, const char *path) {
  const char *found = find(at, path);
  return found && *found == 't';
}

/* The direction of an angle in rad, between -pi and pi. */
static double wrap(double angle) { return atan2(sin(angle), cos(angle)); }

/* Writes the part of a command that drives to a place in m, to end there at rest and facing `heading`. */
static void drive_to(const char *sight, double x, double y, double heading) {
  double dx = x - number(sight, "self.x"), dy = y - number(sight, "self.y"), own = number(sight, "self.heading");
  double speed = fmin(TOP_SPEED, 1.5 * hypot(dx, dy));
  double direction = atan2(dy, dx) - own; /* in the body frame: 0 is the kicking direction */
  double omega = fmax(-4.0, fmin(4.0, 3.0 * wrap(heading - own)));
  printf(",\"drive\":{\"vx\":%.4f,\"vy\":%.4f,\"omega\":%.4f}", speed * cos(direction), speed * sin(direction), omega);
}

/* Writes the command for a sight. */
static void act(const char *sight, double goal_line) {
  double x = number(sight, "self.x"), y = number(sight, "self.y");
  double to_goal = atan2(-y, goal_line - x); /* our team attacks +x */
  const char *phase = find(sight, "game.phase");
  bool is_theirs = phase && strncmp(phase, "\"their_", 7) == 0;

  printf("{\"answers_tick\":%.0f,\"dribble\":true", number(sight, "tick"));
  if (!is_true(sight, "game.running") || is_theirs) {
    /* rests: the drive's default */
  } else if (is_true(sight, "holding") && x > goal_line - SHOOTING_DISTANCE) {
    drive_to(sight, x, y, to_goal);
    if (fabs(wrap(to_goal - number(sight, "self.heading"))) < AIM && is_true(sight, "kicker_ready"))
      printf(",\"kick\":{\"mode\":\"ground\",\"speed\":8.0}");
  } else if (is_true(sight, "holding")) {
    drive_to(sight, goal_line - SHOOTING_DISTANCE + 1.0, 0.0, to_goal);
  } else {
    const char *ball = find(sight, "ball");
    if (!ball || *ball != '{') ball = find(sight, "game.spot"); /* not seen yet: where the referee has placed it */
    if (ball && *ball == '{') {
      double ball_x = number(ball, "x"), ball_y = number(ball, "y");
      drive_to(sight, ball_x, ball_y, atan2(ball_y - y, ball_x - x));
    }
  }
  printf("}\n");
  fflush(stdout); /* a command that stays in a buffer is not sent */
}

int main(void) {
  static char line[LONGEST_LINE];
  if (!fgets(line, sizeof line, stdin)) return 1;
  double goal_line = number(line, "setup.pitch.length") / 2.0;
  fprintf(stderr, "the goal line is at x = %.1f m\n", goal_line);
  while (fgets(line, sizeof line, stdin)) act(line, goal_line);
  return 0;
}
