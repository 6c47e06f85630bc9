#include "structured/lift/statements.h"

#include "base/units.h"
#include "compiler/analyse/reading.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>
#include <span>

namespace orb::structured::lifting {
namespace {

using compiler::ItemKind;
using compiler::StatementNode;
using spec::Operator;
using spec::Statement;

/// A duration in the customary unit.
std::string duration(std::int32_t ms) {
  return ms >= 1000 && ms % 100 == 0 ? thousandths_text(ms) + "s" : fmt::format("{}ms", ms);
}

class StatementWriter {
public:
  StatementWriter(const compiler::Program& program, LiftedValues& values)
      : program_(program), values_(values) {}

  std::string write(const StatementNode& statement) {
    const auto word = spec::info(statement.kind).word;
    const auto items = program_.items_of(statement);
    const auto value = [&](const compiler::Item& item) { return values_.text(item); };
    const auto place = [&](const compiler::Item& item) { return values_.place(item); };
    switch (spec::info(statement.kind).form) {
    case spec::Form::Assignment: return assignment(items[0], items[1]);
    case spec::Form::Output: return print(items);
    case spec::Form::Entry:
      return items.size() < 2 ? fmt::format("{} {}", word, place(items[0]))
                              : fmt::format("{} {}, {}, {}", word, place(items[0]), time(items[1]),
                                            value(items[2]));
    case spec::Form::Variables: return words(word, items, place);
    case spec::Form::Values: {
      const auto most = static_cast<std::size_t>(spec::value_of(spec::Limit::DataValues));
      return words(word, items.first(std::min(items.size(), most)), value);
    }
    case spec::Form::Arguments:
      if (statement.kind == Statement::Sleep)
        return sleep(statement);
      if (statement.kind == Statement::Delay)
        return fmt::format("{} {}", word, time(items[0]));
      if (statement.kind == Statement::Goroll)
        return words(word, items, value) + go_value(items);
      return words(word, items, value);
    case spec::Form::Branch:
    case spec::Form::Conditional:
    case spec::Form::Loop:
    case spec::Form::LoopEnd:
    case spec::Form::IndexedBranch: break; // written as calls and blocks
    }
    return {};
  }

private:
  template <typename Text>
  static std::string words(std::string_view word, std::span<const compiler::Item> items,
                           Text text) {
    std::string out(word);
    for (std::size_t i = 0; i < items.size(); ++i)
      out += (i == 0 ? " " : ", ") + text(items[i]);
    return out;
  }

  std::string time(const compiler::Item& item) {
    const auto& node = program_.nodes[item.value];
    return node.kind == compiler::NodeKind::Number ? duration(node.value) : values_.text(item);
  }

  /// Writes `v = v + e` as `v += e`.
  std::string assignment(const compiler::Item& variable, const compiler::Item& expression) {
    const auto root = expression.value;
    const auto& node = program_.nodes[root];
    const auto op = static_cast<Operator>(node.what);
    const bool short_form = op == Operator::Add || op == Operator::Subtract ||
                            op == Operator::Multiply || op == Operator::Divide ||
                            op == Operator::Remainder;
    if (variable.kind == ItemKind::Letter && node.kind == compiler::NodeKind::Binary &&
        short_form) {
      const auto& left = program_.nodes[node.first];
      const bool same = left.kind == compiler::NodeKind::Letter && left.what == variable.value &&
                        program_.nodes[root - 1].first == node.first + 1;
      if (same) {
        values_.letter_read(variable.value);
        return fmt::format("{} {}= {}", values_.place(variable), spec::info(op).symbol,
                           values_.bare_text(root - 1));
      }
    }
    return fmt::format("{} = {}", values_.place(variable), values_.text(expression));
  }

  /// The go value that `goroll` of old programs implies if the speed is known.
  std::string go_value(std::span<const compiler::Item> items) const {
    const auto speed = compiler::number_in(program_, items[1]);
    if (items.size() != 2 || !speed)
      return "";
    return *speed > 0 ? ", 1" : ", 0";
  }

  /// Writes `sleep`: a wake-up at the first line is `restart`; no line is omitted.
  std::string sleep(const StatementNode& statement) {
    const auto view = program_.as<compiler::SleepView>(statement);
    auto text = fmt::format("sleep {}", values_.text(view.seconds));
    const bool restarts = program_.nodes[view.line.value].value != 0;
    const auto& macro = program_.nodes[view.macro.value];
    if (restarts || macro.kind != compiler::NodeKind::Number || macro.value != 0)
      text += fmt::format(", {}", values_.text(view.macro));
    return restarts ? text + ", restart" : text;
  }

  std::string print(std::span<const compiler::Item> items) {
    std::string text = "print";
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto& item = items[i];
      const auto before = i == 0 ? ItemKind::Semicolon : items[i - 1].kind;
      if (item.kind == ItemKind::Comma) {
        text += i + 1 == items.size() ? " \" \"" : ","; // a final comma would continue the line
      } else if (item.kind == ItemKind::Semicolon) {
        text += ";";
      } else if (item.kind == ItemKind::String) {
        text += fmt::format(" {}", program_.text_of(item.span));
      } else if (item.kind == ItemKind::Character) {
        text += fmt::format(" ${}", values_.operand(item.value));
      } else {
        const auto shown = values_.text(item);
        // Parentheses after a name would be its arguments.
        const bool calls = shown.front() == '(' &&
                           (before == ItemKind::Expression || before == ItemKind::Character);
        text += fmt::format("{} {}", calls ? ";" : "", shown);
      }
    }
    return text;
  }

  const compiler::Program& program_;
  LiftedValues& values_;
};

} // namespace

std::string statement_text(const compiler::Program& program, const StatementNode& statement,
                           LiftedValues& values) {
  return StatementWriter(program, values).write(statement);
}

} // namespace orb::structured::lifting
