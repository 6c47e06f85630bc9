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

/// What the names of an expression stand for at a moment of a run.
class Meaning {
public:
  virtual ~Meaning() = default;
  /// Nothing where there is no such variable now.
  virtual std::optional<std::int32_t> variable(std::string_view name) const = 0;
  /// Why there is none: a sentence.
  virtual std::string missing(std::string_view name) const = 0;
  /// The value of an element, from 1; nothing where there is none.
  virtual std::optional<std::int32_t> element(std::string_view name, std::int32_t index) const = 0;
  virtual std::int32_t sensor(spec::Variable variable) const = 0;
};

/// An expression or a condition as structured programs have them, over variables, sensors and
/// `time`. It only looks: it changes nothing and draws no random numbers.
class Expression {
public:
  /// What is wrong with it is a sentence.
  static tl::expected<Expression, std::string> parse(std::string_view text);

  const std::string& text() const { return text_; }
  /// Whether it is true or false, not a number.
  bool is_condition() const { return program_->nodes[root_].is_condition(); }
  /// The names in it that the program gives a meaning.
  std::vector<std::string_view> names() const;
  /// Its value; 1 and 0 of a condition. What keeps it from having one is a sentence.
  tl::expected<std::int32_t, std::string> value(const Meaning& meaning) const;

private:
  Expression() = default;

  std::string text_;
  std::shared_ptr<const structured::Program> program_;
  std::uint32_t root_ = 0;
};

} // namespace orb::debug
