#pragma once

#include "playground/engine/floor.h"
#include "playground/engine/request.h"
#include "testing/run_suite.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>

namespace orb::playground {

/// Tests of JavaScript programs. Such a program runs outside of the engine and drives a robot of
/// the floor: here are the world of each case, what is heard of its run, and its result.
class Trials {
public:
  Trials();
  ~Trials();

  /// Reads the tests of a request and tells which cases somebody else has to run.
  Answer start(Request& request);
  /// Puts a robot for a case on the floor.
  Answer add_robot(Request& request, Floor& floor);
  /// The program that drives this robot begins now; nothing for robots of no case.
  void begin(const robot::Robot& robot);
  /// The program is over: what follows stops the robot.
  void over(const robot::Robot& robot);
  /// The program prints a text.
  Answer print(robot::Robot& robot, Request& request);
  /// The robot is stopped: waits for its rest and judges the run.
  Answer judge(robot::Robot& robot, Request& request);
  /// The program of a case cannot be run.
  Answer fail(Request& request);
  /// Runs all other cases; tells the results of all.
  Answer end(Request& request);
  /// Forgets the robot before it is gone; without one all of them.
  void forget(const robot::Robot* robot);

private:
  class Run;
  struct Case {
    const testing::Group* group;
    std::uint64_t seed;
  };
  tl::expected<Case, Problem> find(const Request& request) const;
  void take(const Case& one, testing::CaseResult result);

  std::optional<testing::Suite> suite_;
  std::vector<Case> cases_;
  std::map<const robot::Robot*, std::unique_ptr<Run>> runs_;
  std::map<std::pair<const testing::Group*, std::uint64_t>, testing::CaseResult> results_;
};

/// The files that the tests of a request name and that it lacks.
Answer missing_files(Request& request);

} // namespace orb::playground
