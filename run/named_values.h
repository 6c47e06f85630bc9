#pragma once

#include "report/journey.h"
#include "run/input.h"
#include "vm/machine/machine.h"

#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

namespace orb::run {

/// Follows the variables of a program by their names in the source: after each line it reads those
/// that the line names. A letter of the robot may serve one variable here and another there.
class NamedValues {
public:
  /// Tells the journey which variables there are. The program must outlive this.
  NamedValues(const Program& program, report::Journey& journey);

  /// A line of the robot has ended.
  void line_ended(Duration t, int line, const vm::Machine& machine, report::Journey& journey) const;

private:
  struct Held {
    std::size_t place = 0;    ///< of the machine
    std::size_t variable = 0; ///< of the journey
  };
  struct Names {
    std::vector<Held> held;
    bool sets_element = false; ///< one of Z: which, Y says
  };
  using Known = std::vector<std::pair<std::string, std::string>>; ///< names and owners

  void take_letters(const compiler::Program& program, Known& known);
  void take_symbols(const structured::Compiled& compiled, Known& known);
  void take_elements(const compiler::Program& program, const structured::Compiled* compiled,
                     Known& known);

  std::unordered_map<int, Names> lines_;
  std::map<std::size_t, std::size_t> elements_; ///< by number: the variable of the journey
};

} // namespace orb::run
