#pragma once

#include "spec/basic.h"
#include "structured/text/program.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace orb::debug {

/// Looks up the names of an expression at a moment of a run.
class Meaning {
public:
  virtual ~Meaning() = default;
  /// Returns nothing if there is no such variable at this moment.
  virtual std::optional<std::int32_t> variable(std::string_view name) const = 0;
  /// Says why there is none, in a sentence.
  virtual std::string missing(std::string_view name) const = 0;
  /// The value of an element, counted from 1; nothing if there is none.
  virtual std::optional<std::int32_t> element(std::string_view name, std::int32_t index) const = 0;
  virtual std::int32_t sensor(spec::Variable variable) const = 0;
};

/// An expression or condition in the syntax of structured programs, over variables, sensors and
/// `time`. Evaluating it has no side effects and draws no random numbers.
class Expression {
public:
  /// Fails with a sentence.
  static tl::expected<Expression, std::string> parse(std::string_view text);

  const std::string& text() const { return text_; }
  /// True if its value is true or false, not a number.
  bool is_condition() const { return program_->nodes[root_].is_condition(); }
  /// The names in it that have to be looked up.
  std::vector<std::string_view> names() const;
  /// Evaluates it; a condition gives 1 or 0. Fails with a sentence.
  tl::expected<std::int32_t, std::string> value(const Meaning& meaning) const;

private:
  Expression() = default;

  std::string text_;
  std::shared_ptr<const structured::Program> program_;
  std::uint32_t root_ = 0;
};

} // namespace orb::debug
