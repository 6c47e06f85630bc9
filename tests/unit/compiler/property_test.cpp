// Properties of any program, tested on many random ones.

#include "compiler/check.h"
#include "compiler/load.h"
#include "compiler/renumber.h"
#include "compiler/text/image.h"
#include "compiler/text/parse_basic.h"
#include "compiler/text/print.h"
#include "compiler/text/rules.h"
#include "tests/random_program.h"
#include "vm/machine/machine.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <set>
#include <sstream>
#include <string>
#include <variant>

namespace orb::compiler {
namespace {

using testing::RandomProgram;

/// Sensors with changing values, the same in every run; records everything a program does.
class Notebook final : public vm::Host {
public:
  std::int32_t read(spec::Variable variable, Instant) override {
    const auto& row = spec::info(variable);
    const auto span =
        static_cast<std::uint64_t>(static_cast<std::int64_t>(row.greatest) - row.least + 1);
    return static_cast<std::int32_t>(row.least + static_cast<std::int64_t>(random_.below(span)));
  }
  std::optional<spec::BasicError> write(spec::Variable variable, std::int32_t value,
                                        Instant) override {
    notes += fmt::format("{}={}\n", spec::info(variable).word, value);
    return std::nullopt;
  }
  std::optional<spec::BasicError> perform(spec::Statement statement,
                                          std::span<const std::int32_t> arguments,
                                          Instant now) override {
    notes += fmt::format("{} {}:", now.time_since_epoch().count(), spec::info(statement).word);
    for (const auto argument : arguments)
      notes += fmt::format(" {}", argument);
    if (statement == spec::Statement::Goroll && arguments.size() == 2)
      notes += arguments[1] > 0 ? " 1" : " 0"; // the default of the third
    notes += '\n';
    return std::nullopt;
  }
  std::optional<Instant> print(std::string_view text, Instant) override {
    notes += fmt::format("print {}\n", text);
    return std::nullopt;
  }
  void line_ended(int line, Instant) override { lines.push_back(line); }

  std::string notes;
  std::vector<int> lines;

private:
  Random random_{7};
};

struct Run {
  std::string notes;
  std::vector<int> lines;
  std::optional<vm::Machine::Termination> stop;
};

Run run(std::string_view text) {
  Notebook host;
  vm::Machine machine(3000, 5);
  machine.trace_lines();
  auto chunk = load(text);
  const int first = chunk.lines.empty() ? 0 : chunk.lines.front().number;
  machine.start(std::move(chunk), first, Instant{});
  const Instant limit = Instant{} + 200ms;
  while (machine.running() && machine.next_event() < limit)
    machine.run(limit, host);
  Run result;
  result.notes = std::move(host.notes);
  result.lines = std::move(host.lines);
  result.stop = machine.take_termination();
  if (result.stop)
    result.notes += fmt::format("stop {} {}\n", result.stop->line,
                                result.stop->error ? static_cast<int>(*result.stop->error) : 0);
  return result;
}

constexpr std::uint64_t programs = 1000;

std::string valid_program(std::uint64_t seed) {
  return RandomProgram(seed, {}).write();
}

std::string any_program(std::uint64_t seed) {
  RandomProgram::Style style;
  style.lines = 8;
  style.broken = 0.3;
  return RandomProgram(seed, style).write();
}

TEST(Property, TheGeneratorWritesWhatParses) {
  std::size_t faults = 0;
  for (std::uint64_t seed = 0; seed < programs; ++seed) {
    const auto text = valid_program(seed);
    const auto program = parse(text);
    for (const auto& fault : program.faults) {
      ++faults;
      ADD_FAILURE() << program.text_of(program.lines[fault.line].span);
    }
    if (faults > 5)
      return;
  }
}

TEST(Property, PackingKeepsBehaviour) {
  for (std::uint64_t seed = 0; seed < programs; ++seed) {
    const auto text = valid_program(seed);
    const auto program = parse(text);
    const auto plain = build_image(program, Packing::Plain).bytes;
    const auto packed = build_image(program, Packing::Packed).bytes;
    EXPECT_LE(packed.size(), plain.size());
    EXPECT_EQ(plain.size(), image_size(program));
    ASSERT_EQ(run(plain).notes, run(packed).notes) << text << "---\n" << packed;
    ASSERT_EQ(run(plain).notes, run(text).notes) << text;
  }
}

TEST(Property, PackingIsDoneOnceAndKeepsBrokenLines) {
  for (std::uint64_t seed = 0; seed < programs; ++seed) {
    const auto text = any_program(seed);
    const auto packed = build_image(parse(text), Packing::Packed).bytes;
    const auto again = build_image(parse(packed), Packing::Packed).bytes;
    ASSERT_EQ(packed, again) << text;
    ASSERT_EQ(run(build_image(parse(text), Packing::Plain).bytes).notes, run(packed).notes)
        << text << "---\n"
        << packed;
  }
}

TEST(Property, FormattingIsIdempotentAndKeepsTheProgram) {
  for (std::uint64_t seed = 0; seed < programs; ++seed) {
    const auto text = seed % 2 == 0 ? valid_program(seed) : any_program(seed);
    const auto once = format(parse(text));
    ASSERT_EQ(once, format(parse(once))) << text;
    ASSERT_EQ(build_image(parse(text), Packing::Packed).bytes,
              build_image(parse(once), Packing::Packed).bytes)
        << text << "---\n"
        << once;
  }
}

/// One test for each quarter, so that they run in parallel.
constexpr std::uint64_t quarters = 4;
class AQuarterOfThePrograms : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(AQuarterOfThePrograms, IsFinalAfterFixing) {
  for (auto seed = GetParam(); seed < programs; seed += quarters) {
    const auto text = any_program(seed);
    const auto once = fix(text, {});
    const auto twice = fix(once.text, {});
    ASSERT_EQ(twice.count, 0U) << once.text;
    const auto left = check(once.text, {}).diagnostics;
    for (const auto& d : left) { // the remaining fixes would break something else
      if (!d.fix || d.fix->safety != Safety::Safe)
        continue;
      const auto made = apply_fixes(once.text, {d}).text;
      const auto after = check(made, {}).diagnostics;
      const auto worse = std::any_of(after.begin(), after.end(), [&](const Diagnostic& one) {
        const auto of_kind = [&](const std::vector<Diagnostic>& all) {
          return std::count_if(all.begin(), all.end(),
                               [&](const Diagnostic& other) { return other.rule == one.rule; });
        };
        return is_error(one) && of_kind(after) > of_kind(left);
      });
      ASSERT_TRUE(worse) << d.rule->id << " is left in\n" << once.text;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Property, AQuarterOfThePrograms,
                         ::testing::Range(std::uint64_t{0}, quarters));

/// Returns the line with this number; empty if there is none.
std::string line_of(const std::string& text, const std::string& number) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (std::string first; std::istringstream(line) >> first && first == number)
      return line;
  return {};
}

/// Returns true if the fixed program does the same. If the program stops at a line that the fix
/// changed (an unmatched `next`), compares what it did until then.
bool does_the_same(const std::string& text, const std::string& fixed) {
  const auto before = run(text).notes;
  const auto after = run(fixed).notes;
  constexpr std::string_view mark = "stop ";
  const auto stop = before.rfind(mark);
  if (before == after || stop == std::string::npos)
    return before == after;
  const auto number =
      before.substr(stop + mark.size(), before.find(' ', stop + mark.size()) - stop - mark.size());
  return line_of(text, number) != line_of(fixed, number) &&
         after.starts_with(before.substr(0, stop));
}

// Safe fixes do not change the effect of a program that parses.
TEST(Property, SafeFixesKeepBehaviour) {
  for (std::uint64_t seed = 0; seed < programs; ++seed) {
    const auto text = valid_program(seed);
    const auto fixed = fix(text, {});
    ASSERT_TRUE(does_the_same(text, fixed.text)) << text << "---\n" << fixed.text;
  }
}

TEST(Property, WhatCheckAcceptsNeverFailsToParseOnTheRobot) {
  std::size_t accepted = 0;
  for (std::uint64_t seed = 0; seed < 4 * programs; ++seed) {
    RandomProgram::Style style;
    style.lines = 5;
    style.broken = 0.1;
    const auto text = RandomProgram(seed, style).write();
    const auto checked = check(text, {});
    if (std::any_of(checked.diagnostics.begin(), checked.diagnostics.end(),
                    [](const auto& d) { return d.severity == Severity::Error; }))
      continue;
    ++accepted;
    const auto result = run(text);
    if (!result.stop || !result.stop->error)
      continue;
    ASSERT_NE(result.stop->error, spec::BasicError::SyntaxError) << text;
    ASSERT_NE(result.stop->error, spec::BasicError::UnknownStatement) << text;
  }
  EXPECT_GT(accepted, 300U);
}

// The linter's errors are certain: a line with an error that the robot would report never
// completes.
TEST(Property, LinesWithAnErrorStopTheRobot) {
  std::size_t met = 0;
  std::set<std::string_view> rules_met;
  for (std::uint64_t seed = 0; seed < 4 * programs; ++seed) {
    RandomProgram::Style style;
    style.lines = 4 + static_cast<int>(seed % 16);
    const auto text = RandomProgram(seed, style).write();
    const auto checked = check(text, {});
    std::set<std::uint32_t> doomed;
    for (const auto& d : checked.diagnostics) {
      // An `if` may take the other branch.
      const auto line = std::find_if(
          checked.program.lines.begin(), checked.program.lines.end(),
          [&](const Line& l) { return l.span.begin <= d.span.begin && d.span.begin < l.span.end; });
      const bool certain = d.severity == Severity::Error && d.rule->robot_error != 0 &&
                           d.basic_line && line != checked.program.lines.end() &&
                           line->has_statement() &&
                           checked.program.statements[line->statement].kind != spec::Statement::If;
      if (certain && d.rule != &rules::MissingTarget && d.rule != &rules::EmptyTarget) {
        doomed.insert(*d.basic_line);
        rules_met.insert(d.rule->id);
      }
    }
    if (doomed.empty())
      continue;
    const auto result = run(text);
    for (const auto line : result.lines) {
      if (doomed.contains(static_cast<std::uint32_t>(line))) {
        ASSERT_TRUE(result.stop && result.stop->error && result.stop->line == line)
            << "line " << line << " runs through in\n"
            << text << result.notes;
      }
    }
    if (result.stop && result.stop->error &&
        doomed.contains(static_cast<std::uint32_t>(result.stop->line)))
      ++met;
  }
  EXPECT_GT(met, 200U);
  EXPECT_GE(rules_met.size(), 6U);
}

TEST(Property, RenumberingKeepsThePathOfAProgram) {
  std::size_t renumbered = 0;
  for (std::uint64_t seed = 0; seed < programs; ++seed) {
    const auto text = valid_program(seed);
    if (text.find("tron") != std::string::npos)
      continue; // it prints line numbers
    const auto result = renumber(parse(text), {1000, 7});
    const auto* after = std::get_if<std::string>(&result);
    if (after == nullptr)
      continue;
    ++renumbered;
    const auto a = run(text);
    const auto b = run(*after);
    ASSERT_EQ(a.lines.size(), b.lines.size()) << text << *after;
    for (std::size_t i = 0; i < a.lines.size(); ++i)
      ASSERT_EQ(1000 + (a.lines[i] / 10 - 1) * 7, b.lines[i]) << text << *after;
  }
  EXPECT_GT(renumbered, 100U);
}

// Random bytes: no crash, and every span lies within the text.
TEST(Property, AnyBytesAreSurvived) {
  Random random{3};
  for (int n = 0; n < 3000; ++n) {
    std::string text;
    const auto size = random.below(200);
    static constexpr std::string_view usual =
        "10 \n\r\t'\"?ifthenelsforgotABZ=<>!+-*/%{}&|(),;$:.9";
    for (std::uint64_t i = 0; i < size; ++i)
      text += random.chance(0.95) ? usual[random.below(usual.size())]
                                  : static_cast<char>(random.below(256));
    const auto formatted = format(parse(text));
    ASSERT_EQ(formatted, format(parse(formatted))) << text;
    static_cast<void>(load(text));
    if (n % 20 != 0)
      continue; // nearly every line is wrong and gets a repair
    const auto checked = check(text, {});
    for (const auto& d : checked.diagnostics) {
      ASSERT_LE(d.span.begin, d.span.end);
      ASSERT_LE(d.span.end, text.size());
    }
    static_cast<void>(fix(text, {}));
  }
}

} // namespace
} // namespace orb::compiler
