#pragma once

// Private to repair/.

#include "base/source.h"
#include "repair/idioms.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::repair {

/// Longer lines are not looked at.
inline constexpr std::size_t longest_line = 240;

/// What is around the lines of a text: names, open loops, free letters.
class Scenery {
public:
  Scenery(const Source& source, Language language);

  /// Words that stand in other lines, too, or more than once.
  std::vector<std::string_view> names_without(const Tokens& line) const;

  /// A name that is written once and is near `word`: its misspelt definition.
  std::optional<std::string> misspelt(std::string_view word,
                                      const std::vector<std::string_view>& known) const;

  /// The number of the line that begins with `name:`, as a label or in a comment; empty without.
  std::string number_of(std::string_view name) const;

  Surroundings around(std::uint32_t line, const SplitLine& parts) const;

private:
  std::string free_letter() const;

  std::string loop_above(std::uint32_t line) const;

  std::string closer_above(std::uint32_t line) const;

  const Source& source_;
  Language language_;
  std::map<std::string, std::size_t> words_;
};

} // namespace orb::repair
