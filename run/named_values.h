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

/// Tracks the variables of a program by their source names: reads after each line those that the
/// line may set. One robot letter may hold different variables in different lines.
class NamedValues {
public:
  /// Adds the variables to the journey. The program must outlive this object.
  NamedValues(const Program& program, report::Journey& journey);

  /// Called after each robot line.
  void line_ended(Duration t, int line, const vm::Machine& machine, report::Journey& journey) const;

private:
  struct RegisterBinding {
    std::size_t place = 0;    ///< register of the machine
    std::size_t variable = 0; ///< index in the journey
  };
  struct Names {
    std::vector<RegisterBinding> bindings;
    bool sets_element = false; ///< an element of Z, selected by Y
  };
  using Known = std::vector<std::pair<std::string, std::string>>; ///< names and owners

  void take_letters(const compiler::Program& program, Known& known);
  void take_symbols(const structured::Compiled& compiled, Known& known);
  void take_elements(const compiler::Program& program, const structured::Compiled* compiled,
                     Known& known);

  std::unordered_map<int, Names> lines_;
  std::map<std::size_t, std::size_t> elements_; ///< by element number: index in the journey
};

} // namespace orb::run
