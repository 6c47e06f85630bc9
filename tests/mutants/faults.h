#pragma once

#include "slips/judge.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace mutants {

/// Runs programs with a mistake on the virtual ball and counts those stopped by a fault although
/// `orb check` found nothing.
class Faults {
public:
  /// `at` is the changed line, from 0.
  void judge(const std::string& name, slips::Language language, const slips::Lines& mutant,
             std::size_t at);

  std::size_t count() const;

  /// Prints a table, and the programs without a finding.
  void report() const;

private:
  struct Counts {
    std::size_t mutants = 0;
    std::size_t errors = 0;  ///< not run, as they have errors
    std::size_t faults = 0;  ///< that a fault stops
    std::size_t away = 0;    ///< of these, without a finding on the line of the fault
    std::size_t nothing = 0; ///< without any finding
  };

  std::array<Counts, std::size(slips::endings)> counts_{};
  std::vector<std::string> silent_; ///< without a finding, for people to read
};

} // namespace mutants
