#include "assembler/lint/lint_meant.h"

#include "assembler/lint/edits.h"
#include "assembler/lint/lint_timing.h"
#include "assembler/text/rules.h"
#include "assembler/text/texts.h"
#include "base/fixes.h"
#include "repair/tokens.h"
#include "spec/ball.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

namespace orb::assembler {
namespace {

using spec::MacroCommand;
using Origin = PlacedCommand::Origin;

/// A stored system value and the mnemonics for it: `set_sd1` sets it, `roll_sd1` uses it.
struct Kept {
  std::string_view set;
  std::string_view use;                       ///< part of the mnemonics that use it
  const Row<Hole::Code, Hole::Number>* unset; ///< the message if it is used but not set
  int number;
};
constexpr auto kept = std::to_array<Kept>({{"set_sd1", "_sd1", &texts::TakesDelay, 1},
                                           {"set_sd2", "_sd2", &texts::TakesDelay, 2},
                                           {"set_spd1", "_spd1", &texts::TakesSpeed, 1},
                                           {"set_spd2", "_spd2", &texts::TakesSpeed, 2}});

class MeantLinter {
public:
  MeantLinter(const Source& source, const Assembly& assembly)
      : source_(source), assembly_(assembly) {}

  std::vector<Diagnostic> run() {
    for (const auto& macro : assembly_.macros) {
      for (const auto& command : macro.commands) {
        if (command.info == nullptr || command.origin == Origin::Raw)
          return {}; // unknown commands may follow
        check_colour(command);
        check_heading(command);
      }
      check_exchanged(macro);
    }
    check_kept();
    return std::move(diagnostics_);
  }

private:
  void offer(const Rule& rule, const PlacedCommand& command, Message message,
             const std::string& line, Message why = {}) {
    auto d = finding(rule, command.span, std::move(message),
                     why.empty() ? texts::Write(line) : texts::WriteBecause(line, std::move(why)));
    d.fix = single_fix(texts::Write(line), command.span, line, Safety::Unsafe);
    diagnostics_.push_back(std::move(d));
  }

  /// The positions of the first numbers of a statement, up to the first named operand.
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

  /// Colours of 0 and 1, although the range is 0 to 255.
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
      offer(rules::DimColour, command, texts::AlmostDark(), repair::join(tokens));
  }

  /// A heading on which robots and documents disagree.
  void check_heading(const PlacedCommand& command) {
    if (!is(command, MacroCommand::SetHeading) || command.value[0] == 0 ||
        command.origin != Origin::Written)
      return;
    auto tokens = split(command);
    const auto heading = std::find_if(tokens.begin(), tokens.end(),
                                      [](const auto& token) { return token.is_number(); });
    if (heading == tokens.end())
      return;
    heading->text = "0";
    offer(rules::HeadingOperand, command, texts::BecomesZero(command.value[0]),
          repair::join(tokens), texts::ZeroIsTheSame());
  }

  /// The two numbers of a roll, as written; nothing if a name or a unit identifies them.
  static std::vector<std::size_t> exchangeable(const repair::Tokens& tokens,
                                               const PlacedCommand& roll) {
    auto two = numbers(tokens, 2);
    for (std::size_t i = 0; i < two.size(); ++i) {
      const auto next = two[i] + 1;
      const bool has_unit = next < tokens.size() && tokens[next].is("deg");
      if (has_unit || !tokens[two[i]].is(std::to_string(roll.value[i])))
        return {};
    }
    return two;
  }

  /// The line of a roll with its two numbers swapped; empty if they cannot be swapped.
  std::string exchanged(const PlacedCommand& roll) const {
    auto tokens = split(roll);
    const auto two = exchangeable(tokens, roll);
    if (two.empty())
      return {};
    std::swap(tokens[two[0]].text, tokens[two[1]].text);
    return repair::join(tokens);
  }

  void check_exchanged(const AssembledMacro& macro) {
    std::vector<const PlacedCommand*> all; // that drive
    std::set<std::int32_t> stops;          // the headings of the rolls that stop
    for (const auto& command : macro.commands)
      if (is(command, MacroCommand::Roll) || is(command, MacroCommand::Roll2) ||
          is(command, MacroCommand::RollSd1)) {
        if (command.value[0] > 0)
          all.push_back(&command);
        else if (!all.empty() && command.value[1] > 0)
          stops.insert(command.value[1]);
      }
    if (!check_usual_speed(all))
      check_usual_headings(all, stops);
  }

  /// One roll has the speed of all others as its heading.
  bool check_usual_speed(const std::vector<const PlacedCommand*>& all) {
    for (const auto* one : all) {
      const auto speed = one->value[1];
      const auto others = std::count_if(all.begin(), all.end(), [&](const PlacedCommand* other) {
        return other != one && other->value[0] == speed;
      });
      if (others < 2 || static_cast<std::size_t>(others) + 1 != all.size() ||
          one->value[0] == speed)
        continue;
      if (const auto line = exchanged(*one); !line.empty())
        offer(rules::ExchangedRoll, *one, texts::Swapped(one->value[0], speed, speed), line,
              texts::SpeedFirst());
      return true;
    }
    return false;
  }

  /// Programs turn by multiples of these angles.
  static constexpr std::int32_t eighth = spec::ball::full_circle / 8;
  static constexpr std::int32_t twelfth = spec::ball::full_circle / 12;

  static bool is_usual_heading(std::int32_t value) {
    return value % eighth == 0 || value % twelfth == 0;
  }

  /// True if the speed looks like a heading and the heading like a speed.
  bool is_turned(const PlacedCommand& roll, const std::set<std::int32_t>& stops) const {
    return roll.value[0] % eighth == 0 && !is_usual_heading(roll.value[1]) &&
           roll.value[1] <= spec::ball::greatest && !stops.contains(roll.value[1]) &&
           !exchanged(roll).empty();
  }

  /// Finds rolls whose numbers match the other rolls only if swapped.
  void check_usual_headings(const std::vector<const PlacedCommand*>& all,
                            const std::set<std::int32_t>& stops) {
    std::vector<const PlacedCommand*> turned;
    std::set<std::int32_t> speeds; // of the other rolls
    for (const auto* one : all)
      if (is_turned(*one, stops))
        turned.push_back(one);
      else if (is_usual_heading(one->value[1]) && one->value[0] % eighth != 0)
        speeds.insert(one->value[0]);
      else
        return; // a roll that fits neither order
    const auto others = all.size() - turned.size();
    if (turned.empty())
      return;
    if (others == 0)
      return check_all_turned(turned);
    if (turned.size() > 1 &&
        !std::all_of(turned.begin(), turned.end(),
                     [&](const PlacedCommand* one) { return speeds.contains(one->value[1]); }))
      return;
    for (const auto* one : turned)
      offer(rules::ExchangedRoll, *one, texts::SwappedByLook(one->value[0], one->value[1]),
            exchanged(*one), texts::SpeedFirst());
  }

  /// All rolls of a macro have speed and heading swapped, and their speeds differ.
  void check_all_turned(const std::vector<const PlacedCommand*>& turned) {
    const auto& first = *turned.front();
    const auto other = std::find_if(turned.begin(), turned.end(), [&](const PlacedCommand* one) {
      return one->value[0] != first.value[0];
    });
    if (other == turned.end())
      return;
    const auto line = exchanged(first);
    auto d = finding(rules::ExchangedRoll, first.span,
                     texts::AllSwapped(first.value[0], (*other)->value[0], first.value[1]),
                     texts::WriteBecause(line, texts::SpeedFirst()));
    d.fix = Fix{texts::SwapAll(), {}, Safety::Unsafe};
    for (const auto* one : turned)
      d.fix->edits.push_back({one->span, exchanged(*one)});
    diagnostics_.push_back(std::move(d));
  }

  template <typename Fits>
  const PlacedCommand* first(Fits fits) const {
    for (const auto& macro : assembly_.macros)
      for (const auto& command : macro.commands)
        if (fits(command.info->mnemonic))
          return &command;
    return nullptr;
  }

  const PlacedCommand* setter(const Kept& one) const {
    return first([&](std::string_view mnemonic) { return mnemonic == one.set; });
  }
  const PlacedCommand* user(const Kept& one) const {
    return first([&](std::string_view mnemonic) {
      return mnemonic != one.set && mnemonic.find(one.use) != std::string_view::npos;
    });
  }

  /// One system value is set but not used; its twin is used but not set.
  void check_kept() {
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const auto& one = kept[i];
      const auto& other = kept[i ^ 1U];
      const auto* uses = user(one);
      const auto* sets = setter(other);
      if (uses == nullptr || sets == nullptr || setter(one) != nullptr || user(other) != nullptr)
        continue;
      auto line = std::string(source_.text(sets->span));
      line.replace(0, sets->info->mnemonic.size(), one.set);
      offer(rules::OtherSystemValue, *sets, (*one.unset)(uses->info->mnemonic, one.number), line);
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
