#include "assembler/lint_meant.h"

#include "assembler/edits.h"
#include "assembler/lint_timing.h"
#include "assembler/rules.h"
#include "repair/tokens.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>
#include <utility>

namespace orb::assembler {
namespace {

using spec::MacroCommand;
using Origin = PlacedCommand::Origin;

/// A value that the system keeps: what sets it, what uses it, and the other of its kind.
struct Kept {
  MacroCommand set;
  MacroCommand other;
  std::string_view name;
  std::array<MacroCommand, 4> used_by;
};
constexpr auto kept =
    std::to_array<Kept>({{MacroCommand::SetSd1,
                          MacroCommand::SetSd2,
                          "system delay 1",
                          {MacroCommand::RollSd1, MacroCommand::RollSpd1Sd1,
                           MacroCommand::RollSpd2Sd1, MacroCommand::RotateSd1}},
                         {MacroCommand::SetSd2,
                          MacroCommand::SetSd1,
                          "system delay 2",
                          {MacroCommand::RgbSd2, MacroCommand::RotateSd2, MacroCommand::RgbSd2,
                           MacroCommand::RotateSd2}},
                         {MacroCommand::SetSpd1,
                          MacroCommand::SetSpd2,
                          "system speed 1",
                          {MacroCommand::RollSpd1Sd1, MacroCommand::RollSpd1Sd1,
                           MacroCommand::RollSpd1Sd1, MacroCommand::RollSpd1Sd1}},
                         {MacroCommand::SetSpd2,
                          MacroCommand::SetSpd1,
                          "system speed 2",
                          {MacroCommand::RollSpd2Sd1, MacroCommand::RollSpd2Sd1,
                           MacroCommand::RollSpd2Sd1, MacroCommand::RollSpd2Sd1}}});

class MeantLinter {
public:
  MeantLinter(const Source& source, const Assembly& assembly)
      : source_(source), assembly_(assembly) {}

  std::vector<Diagnostic> run() {
    for (const auto& macro : assembly_.macros) {
      for (const auto& command : macro.commands) {
        if (command.info == nullptr || command.origin == Origin::Raw)
          return {}; // who knows what else is done
        check_colour(command);
      }
      check_exchanged(macro);
    }
    check_kept();
    return std::move(diagnostics_);
  }

private:
  void offer(const Rule& rule, const PlacedCommand& command, std::string message,
             const std::string& line, std::string_view why) {
    auto d = finding(rule, command.span, std::move(message),
                     fmt::format("write `{}`{}{}", line, why.empty() ? "" : "; ", why));
    d.fix = Fix{fmt::format("write `{}`", line), {{command.span, line}}, Safety::Unsafe};
    diagnostics_.push_back(std::move(d));
  }

  /// Where the first numbers of a statement stand, up to the first that has a name.
  static std::vector<std::size_t> numbers(const repair::Tokens& statement, std::size_t most) {
    std::vector<std::size_t> found;
    for (std::size_t i = 1; i < statement.size() && found.size() < most; ++i) {
      if (statement[i].is("="))
        return {};
      if (statement[i].is_number())
        found.push_back(i);
    }
    return found.size() == most ? found : std::vector<std::size_t>();
  }

  repair::Tokens split(const PlacedCommand& command) const {
    return repair::tokens_of(source_.text(command.span), repair::Language::Macro);
  }

  /// Colours of 0 and 1: they go to 255.
  void check_colour(const PlacedCommand& command) {
    const auto kind = command.info->command;
    const std::size_t channels =
        kind == MacroCommand::BackLed ? 1
        : kind == MacroCommand::Rgb || kind == MacroCommand::RgbSd2 || kind == MacroCommand::Fade
            ? 3
            : 0;
    if (channels == 0 || command.origin != Origin::Written)
      return;
    std::int32_t most = 0;
    for (std::size_t i = 0; i < channels; ++i)
      most = std::max(most, command.value[i]);
    if (most != 1)
      return;
    auto tokens = split(command);
    bool changed = false;
    for (const auto i : numbers(tokens, channels))
      if (tokens[i].is("1")) {
        tokens[i].text = "255";
        changed = true;
      }
    if (changed)
      offer(rules::DimColour, command, "this is all but dark: a brightness goes from 0 to 255",
            repair::join(tokens), "");
  }

  /// One roll has the speed of all others as its heading.
  void check_exchanged(const AssembledMacro& macro) {
    std::vector<const PlacedCommand*> all;
    for (const auto& command : macro.commands)
      if ((is(command, MacroCommand::Roll) || is(command, MacroCommand::Roll2) ||
           is(command, MacroCommand::RollSd1)) &&
          command.value[0] > 0)
        all.push_back(&command);
    for (const auto* one : all) {
      const auto speed = one->value[1];
      const auto others = std::count_if(all.begin(), all.end(), [&](const PlacedCommand* other) {
        return other != one && other->value[0] == speed;
      });
      if (others < 2 || static_cast<std::size_t>(others) + 1 != all.size() ||
          one->value[0] == speed)
        continue;
      auto tokens = split(*one);
      const auto two = numbers(tokens, 2);
      if (two.empty())
        return;
      std::swap(tokens[two[0]].text, tokens[two[1]].text);
      offer(rules::ExchangedRoll, *one,
            fmt::format("speed {} and heading {} seem exchanged: all other rolls have speed {}",
                        one->value[0], speed, speed),
            repair::join(tokens), "the speed stands first");
      return;
    }
  }

  const PlacedCommand* first(MacroCommand kind) const {
    for (const auto& macro : assembly_.macros)
      for (const auto& command : macro.commands)
        if (is(command, kind))
          return &command;
    return nullptr;
  }

  const PlacedCommand* user(const Kept& one) const {
    for (const auto kind : one.used_by)
      if (const auto* command = first(kind))
        return command;
    return nullptr;
  }

  /// One system value is set and not used, the other is used and not set.
  void check_kept() {
    for (const auto& one : kept) {
      const auto* uses = user(one);
      const auto* sets = first(one.other);
      const auto& other = *std::find_if(kept.begin(), kept.end(),
                                        [&](const Kept& each) { return each.set == one.other; });
      if (uses == nullptr || sets == nullptr || first(one.set) != nullptr || user(other) != nullptr)
        continue;
      auto line = std::string(source_.text(sets->span));
      line.replace(0, sets->info->mnemonic.size(), spec::info(one.set).mnemonic);
      offer(rules::OtherSystemValue, *sets,
            fmt::format("nothing uses this: `{}` takes {}", uses->info->mnemonic, one.name), line,
            "");
    }
  }

  const Source& source_;
  const Assembly& assembly_;
  std::vector<Diagnostic> diagnostics_;
};

} // namespace

std::vector<Diagnostic> lint_meant(const Source& source, const Assembly& assembly) {
  if (any_error(assembly.diagnostics))
    return {};
  return MeantLinter(source, assembly).run();
}

} // namespace orb::assembler
