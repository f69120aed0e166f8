// Times the functions of several libraries, interleaved in one process.
//
// `driver ROUNDS LIBRARY..` loads the libraries (see `subject.h`), demands that all results agree with those of the first one
// that has the function, and prints a line of tab-separated words for each subject: robot, function, program, how far its
// results are from the first one's, [ns] of a state the least, lower quartile, median and upper quartile over the rounds, then
// its ratio to the first one's (of programs for any processor to that of the first one for any): of least times, and lower
// quartile, median and upper quartile of those in one round.
//
// A round measures each subject once, for about a millisecond, so what else the machine does meets all of them alike.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <dlfcn.h>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "subject.h"

struct Row
{
  const Subject * subject;
  double error;
  // The first subject with the same robot and function, and the first one of these that was compiled for the same processors.
  std::size_t first, unit;
  // States of a batch.
  std::size_t batch;
  // [ns] of a state, in each round
  std::vector<double> times;
};

[[noreturn]] static void fail(const std::string & message)
{
  std::fprintf(stderr, "%s\n", message.c_str());
  std::exit(1);
}

static std::string name(const Subject & subject)
{
  return std::string(subject.robot) + ", " + subject.function + ", " + subject.program;
}

template<typename Function>
static Function * symbol(void * library, const char * path, const char * name)
{
  void * found = dlsym(library, name);
  if (!found)
    fail(std::string(path) + " exports no " + name);
  return reinterpret_cast<Function *>(found);
}

static std::vector<double> results(const Subject & subject, std::size_t state)
{
  std::vector<double> all(PEERS_RESULTS);
  all.resize(subject.evaluate(state, all.data()));
  return all;
}

static double distance(const std::vector<double> & found, const std::vector<double> & expected)
{
  if (found.size() != expected.size())
    return INFINITY;
  double size = 0, error = 0;
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    // Not numbers are no agreement.
    error = std::fabs(found[k] - expected[k]) <= error ? error : std::fabs(found[k] - expected[k]);
    size = std::max(size, std::fabs(expected[k]));
  }
  return std::isnan(error) ? INFINITY : error / size;
}

// [ns] that this thread has run: what others run meanwhile is none of it.
static double now()
{
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e9 * double(time.tv_sec) + double(time.tv_nsec);
}

// [ns] of a state.
static double measure(const Row & row)
{
  const double start = now();
  row.subject->run(row.batch);
  return (now() - start) / double(row.batch);
}

// The values at a quarter, half and three quarters.
static std::array<double, 3> quartiles(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) { return values[std::size_t(share * (values.size() - 1) + 0.5)]; };
  return {at(0.25), at(0.5), at(0.75)};
}

int main(int words, char ** arguments)
{
  const int rounds = words > 2 ? std::atoi(arguments[1]) : 0;
  if (rounds < 1)
    return std::fprintf(stderr, "usage: driver ROUNDS LIBRARY..\n"), 2;
  std::vector<Row> rows;
  decltype(peers_states) * states = nullptr;
  for (int k = 2; k < words; ++k)
  {
    void * library = dlopen(arguments[k], RTLD_NOW | RTLD_LOCAL);
    if (!library)
      fail(dlerror());
    if (k == 2)
      states = symbol<decltype(peers_states)>(library, arguments[k], "peers_states");
    std::size_t count = 0;
    const Subject * subjects = symbol<decltype(peers_subjects)>(library, arguments[k], "peers_subjects")(&count);
    for (std::size_t i = 0; i < count; ++i)
      rows.push_back({subjects + i, 0, 0, 0, 0, {}});
  }

  std::map<std::string, std::pair<std::vector<double>, std::size_t>> numbers;
  std::map<std::pair<std::string, std::string>, std::size_t> firsts;
  std::map<std::tuple<std::string, std::string, bool>, std::size_t> units;
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    Row & row = rows[k];
    const Subject & subject = *row.subject;
    row.first = firsts.emplace(std::make_pair(subject.robot, subject.function), k).first->second;
    const bool any = std::strstr(subject.program, "any processor");
    row.unit = units.emplace(std::make_tuple(subject.robot, subject.function, any), k).first->second;
    auto & [values, count] = numbers[subject.robot];
    if (values.empty())
    {
      values.resize(1 << 20);
      std::size_t length = 0;
      count = states(subject.robot, values.data(), &length);
    }
    subject.load(values.data(), count);
    for (std::size_t state = 0; state < count; ++state)
    {
      const double error = distance(results(subject, state), results(*rows[row.first].subject, state));
      row.error = std::max(row.error, error);
      if (!(error <= subject.tolerance))
        fail(name(subject) + ": state " + std::to_string(state) + " differs by " + std::to_string(error / 1e-11) + " 1e-11");
    }
    for (row.batch = 64; measure(row) * row.batch < 1e6; row.batch *= 2)
      ;
  }

  for (int round = 0; round < rounds; ++round)
    for (Row & row : rows)
      row.times.push_back(measure(row));

  for (const Row & row : rows)
  {
    const std::vector<double> & unit = rows[row.unit].times;
    std::vector<double> ratios;
    for (int round = 0; round < rounds; ++round)
      ratios.push_back(row.times[round] / unit[round]);
    const auto least = [](const std::vector<double> & times) { return *std::min_element(times.begin(), times.end()); };
    const auto [low, median, high] = quartiles(row.times);
    const auto [low_ratio, median_ratio, high_ratio] = quartiles(ratios);
    std::printf("%s\t%s\t%s\t%.1e", row.subject->robot, row.subject->function, row.subject->program, row.error);
    std::printf("\t%.3f\t%.3f\t%.3f\t%.3f", least(row.times), low, median, high);
    std::printf("\t%.4f\t%.4f\t%.4f\t%.4f\n", least(row.times) / least(unit), low_ratio, median_ratio, high_ratio);
  }
}
