#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace orb::testing {

/// A regular expression in ECMAScript syntax, searched for in lines. The steps of a search are
/// bounded, so no pattern takes long on any line; the bound is the same on every machine.
/// Thread-safe.
class Pattern {
public:
  struct Problem {
    std::size_t at = 0; ///< byte offset in the pattern
    std::string message;
  };

  enum class Found : std::uint8_t { No, Yes, GaveUp };

  static tl::expected<Pattern, Problem> compile(std::string_view text);
  Pattern(Pattern&&) noexcept;
  Pattern& operator=(Pattern&&) noexcept;
  ~Pattern();

  Found search(std::string_view line) const;

private:
  struct Code;
  explicit Pattern(std::unique_ptr<Code> code);

  std::unique_ptr<Code> code_;
};

} // namespace orb::testing
