#pragma once

#include "structured/lift/control_flow.h"

#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace orb::structured::lifting {

/// The comments of a numbered program, as they are kept.
struct Comments {
  std::vector<std::vector<std::string_view>> before; ///< of each line: the comment lines above it
  std::vector<std::string_view> last;                ///< after the last line
};

/// Assigns comments to lines; those above a line that is left out move to the next one. Marks the
/// steps that have comments.
Comments read_comments(const compiler::Program& program, ControlFlow& ways);

/// The names in a lifted program, taken from comments that clearly give one.
class LiftedNames {
public:
  LiftedNames(const compiler::Program& program, const ControlFlow& ways, const Comments& comments);

  const std::string& letter(std::size_t which) const { return letters_[which]; }
  const std::string& sub(std::size_t which) const { return subs_[which]; }
  std::string_view elements() const { return "z"; }
  /// A name for a line that is a jump target.
  std::string label(std::uint32_t line);
  /// Returns `wish`, or `wish_2` and so on if it is taken.
  std::string fresh(std::string_view wish);

private:
  void take_letters(std::string_view comment);
  void name_letter(std::size_t which, std::string name);
  void name_letters_where_set();
  std::string name_of_line(std::uint32_t line) const;
  bool take(const std::string& name);

  const compiler::Program& program_;
  const ControlFlow& ways_;
  const Comments& comments_;
  std::array<std::string, 25> letters_;
  std::vector<std::string> subs_;
  std::set<std::string> taken_;
};

} // namespace orb::structured::lifting
