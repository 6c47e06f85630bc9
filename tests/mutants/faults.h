#pragma once

#include "slips/judge.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace mutants {

/// Runs programs with a mistake on the virtual ball, and asks of those that a fault stops whether
/// `orb check` has said anything.
class Faults {
public:
  /// `at` is the line that was changed, from 0.
  void judge(const std::string& name, slips::Language language, const slips::Lines& mutant,
             std::size_t at);

  std::size_t count() const;

  /// Prints a table, and the programs of which nothing was said.
  void report() const;

private:
  struct Counts {
    std::size_t mutants = 0;
    std::size_t errors = 0;  ///< that do not run: they have errors
    std::size_t faults = 0;  ///< that a fault stops
    std::size_t away = 0;    ///< of these: nothing was said of the line where that happens
    std::size_t nothing = 0; ///< nothing at all
  };

  std::array<Counts, std::size(slips::endings)> counts_{};
  std::vector<std::string> silent_; ///< of which nothing was said, for people
};

} // namespace mutants
