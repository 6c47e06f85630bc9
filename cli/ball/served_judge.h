#pragma once

#include "cli/ball/judged.h"
#include "protocol/judge/judge.h"
#include "serve/spectator.h"
#include "spec/robots.h"

#include <memory>
#include <vector>

namespace orb::cli {

/// Judges the clients of served balls, each from its connection to its end.
class ServedJudge {
public:
  ServedJudge(int count, spec::Robot robot);
  ~ServedJudge();

  serve::Witness* hear(int index);
  /// Ends all conversations, including open ones, and stops listening.
  JudgedLog finish();

private:
  class Seat;
  int count_;
  spec::Robot robot_;
  std::vector<std::unique_ptr<Seat>> seats_;
};

} // namespace orb::cli
