#include "compiler/renumber.h"

#include "base/fixes.h"
#include "compiler/analyse/flow.h"
#include "spec/limits.h"

#include <fmt/format.h>
#include <optional>
#include <vector>

namespace orb::compiler {
namespace {

class Renumberer {
public:
  Renumberer(const Program& program, Numbering numbering)
      : program_(program), flow_(read_flow(program)), numbering_(numbering) {}

  std::variant<std::string, Obstacle> run() {
    for (const auto& fault : program_.faults)
      return Obstacle{fault.span, "the line does not parse, so its line numbers cannot be updated"};
    if (auto obstacle = number_lines())
      return *obstacle;
    if (auto obstacle = follow_targets())
      return *obstacle;
    if (auto obstacle = follow_sleeps())
      return *obstacle;
    return replace();
  }

private:
  std::optional<Obstacle> number_lines() {
    std::uint64_t next = numbering_.start;
    numbers_.resize(program_.lines.size());
    for (std::size_t i = 0; i < program_.lines.size(); ++i) {
      const auto& line = program_.lines[i];
      if (!line.has_number())
        continue;
      constexpr auto greatest = spec::value_of(spec::Limit::GreatestLineNumber);
      if (next > static_cast<std::uint64_t>(greatest))
        return Obstacle{
            line.number_span,
            fmt::format("this line would become {}; the highest number is {}", next, greatest)};
      numbers_[i] = static_cast<std::uint32_t>(next);
      edits_.push_back({line.number_span, std::to_string(next)});
      next += numbering_.step;
    }
    return std::nullopt;
  }

  std::optional<Obstacle> follow_targets() {
    for (const auto& item : program_.items) {
      if (item.kind != ItemKind::Target)
        continue;
      const auto* number = flow_.find(item.value);
      if (number == nullptr)
        return Obstacle{
            item.span,
            fmt::format("there is no line {} now, but there may be one after renumbering",
                        program_.text_of(item.span))};
      edits_.push_back({item.span, std::to_string(numbers_[number->line])});
    }
    return std::nullopt;
  }

  /// The wake-up line belongs to the program in flash. A number without a line in this program
  /// refers to another program and stays.
  std::optional<Obstacle> follow_sleeps() {
    for (const auto& statement : program_.statements) {
      if (statement.error || statement.kind != spec::Statement::Sleep)
        continue;
      const auto& item = program_.as<SleepView>(statement).line;
      const auto& root = program_.nodes[item.value];
      if (root.kind != NodeKind::Number)
        return Obstacle{item.span, "the wake-up line is computed, so it cannot be updated"};
      const auto* number =
          root.value > 0 ? flow_.find(static_cast<std::uint32_t>(root.value)) : nullptr;
      if (number != nullptr)
        edits_.push_back({item.span, std::to_string(numbers_[number->line])});
    }
    return std::nullopt;
  }

  std::string replace() const {
    Diagnostic all;
    all.fix = Fix{{}, edits_, Safety::Safe};
    return apply_fixes(program_.text, {all}).text;
  }

  const Program& program_;
  Flow flow_;
  Numbering numbering_;
  std::vector<std::uint32_t> numbers_; ///< by line
  std::vector<Edit> edits_;
};

} // namespace

std::variant<std::string, Obstacle> renumber(const Program& program, Numbering numbering) {
  return Renumberer(program, numbering).run();
}

} // namespace orb::compiler
