// The robots of `robots.py`: how many numbers their states have.
#pragma once

#include <cstddef>
#include <string>

struct Puma
{
  static constexpr const char * name = "puma560";
  static constexpr int joints = 6, base = 0;
};
struct Panda
{
  static constexpr const char * name = "panda";
  static constexpr int joints = 7, base = 0;
};
struct FourLegged
{
  static constexpr const char * name = "four_legged";
  static constexpr int joints = 12, base = 6;
};
struct Humanoid
{
  static constexpr const char * name = "humanoid";
  static constexpr int joints = 32, base = 6;
};

// A state's numbers.
template<typename Robot>
struct State
{
  static constexpr int dof = Robot::base + Robot::joints, positions = dof + (Robot::base ? 1 : 0);
  static constexpr std::size_t length()
  {
    return positions + 3 * dof;
  }
  const double *q, *v, *a, *effort, *torque;
  explicit State(const double * numbers)
  : q(numbers)
  , v(q + positions)
  , a(v + dof)
  , effort(a + dof)
  , torque(effort + Robot::base)
  {
  }
};

// Where `robots.py` and `codegen` have written.
inline std::string robot_file(const char * name, const char * ending)
{
  return std::string(PEERS_ROBOTS) + "/" + name + ending;
}
