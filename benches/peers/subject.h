// What every library of the comparison exports: functions of robots, each with a loop of its own over prepared states.
//
// A state of a tree with n positions and m velocities is n + 3 m numbers: positions, velocities, accelerations, efforts.
// Those of a floating base are Pinocchio's: a point and a quaternion, real part last; linear and angular velocity and
// acceleration in its own axes. Its efforts are zero. Results are in the same coordinates:
//
//   inverse      efforts of the accelerations
//   forward      accelerations of the efforts
//   mass         the whole mass matrix, by columns
//   derivatives  of `forward` by displacements, velocities and efforts of joints, each by columns
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct
{
  const char *robot, *function, *program;
  // How far results may be from those of the first library, relative to the greatest of them.
  double tolerance;
  // Keeps the states in its own form; called once.
  void (*load)(const double *states, size_t count);
  // Writes the results of one state, at most `PEERS_RESULTS` numbers, and returns how many.
  size_t (*evaluate)(size_t state, double *results);
  // Evaluates `count` states, one after the other and from the first one again.
  void (*run)(size_t count);
} Subject;

#define PEERS_RESULTS 4096

// A library's subjects, and how many there are.
const Subject *peers_subjects(size_t *count);
// Of the first library alone: writes the states of a robot, and returns their number and how long each is.
size_t peers_states(const char *robot, double *states, size_t *length);

#ifdef __cplusplus
}
#endif
