#include "assembler/text/rephrase.h"

#include "assembler/text/program.h"
#include "assembler/text/rewrites.h"

#include "base/duration.h"
#include "base/text/text.h"
#include "base/units.h"
#include "repair/idioms.h"
#include "repair/inflections.h"
#include "spec/macro.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <functional>
#include <set>

namespace orb::assembler {
namespace {

using repair::Counts;
using repair::Operand;
using repair::Rephrased;
using repair::Token;
using repair::Tokens;
using spec::MacroCommand;
using spec::MacroCommandInfo;
using spec::MacroOperandKind;
using spec::MacroUnit;

constexpr std::size_t longest_constant = 240; // bytes; real constants are shorter

/// Spells a name in ASCII: `grün` becomes `grun`.
std::string plain_name(const std::string& word) {
  return std::any_of(word.begin(), word.end(), is_utf8_tail) ? repair::plain_letters(word) : word;
}

// ---- directives

/// Finds the flag that contains the beginnings of all given words: `motor`, `controllo_motore`;
/// null if there is none.
const spec::MacroFlagInfo* flag_called(std::string_view said) {
  constexpr std::size_t beginning = 3; // letters
  const auto parts = repair::parts_of(said);
  for (const auto& row : spec::macro_flags)
    if (std::all_of(parts.begin(), parts.end(), [&](const std::string& part) {
          return row.word.find(part.substr(0, beginning)) != std::string_view::npos;
        }))
      return &row;
  return nullptr;
}

/// Reads `.macro NAME id=40 flags=motor_control`, with its parts in any order.
std::vector<Rephrased> rephrase_header(const Tokens& line) {
  enum class In : std::uint8_t { Name, Id, More, Flags } in = In::Name;
  std::string name;
  std::string id;
  std::vector<std::string_view> flags;
  bool sure = true;
  bool marked = false; // `#35`
  const auto is_id = [](const Token& token) {
    return token.is_word() && equal_words(token.text, "id");
  };
  const bool says_id = std::any_of(line.begin(), line.end(), is_id);
  for (std::size_t i = 1; i < line.size(); ++i) {
    const auto& token = line[i];
    const auto follows = [&](std::size_t n) { return i + n < line.size() ? line[i + n] : Token(); };
    const bool assigned = follows(1).is("=") || follows(1).is(":");
    const bool gives =
        assigned && !name.empty() && token.is_word(); // `numero=40`, `options=endsig`
    if (token.kind == Token::Kind::Sign) {
      marked = marked || token.is("#");
      if (token.is("-") && in == In::Id)
        return {};
    } else if ((holds("call called named", token.text) && name.empty() && follows(1).is_word()) ||
               (equal_words(token.text, "name") && assigned)) {
      in = In::Name;
    } else if (is_id(token) || (gives && (follows(2).is_number() || follows(2).is("#")))) {
      in = In::Id;
    } else if (holds("flags flag", token.text) || (gives && follows(2).is_word())) {
      in = In::Flags;
    } else if (token.is_number() && id.empty() &&
               (in == In::Id || (!says_id && (!name.empty() || follows(1).gap)))) {
      id = token.text;
      in = name.empty() ? In::Name : In::More;
    } else if (token.is_number() && says_id && in == In::Name && !name.empty()) {
      sure = false; // `spin 12s id=53`
      i += follows(1).is_word() && !follows(1).gap ? 1 : 0;
    } else if (token.is_number()) {
      return {};
    } else if (!token.gap && line[i - 1].is_number() && !id.empty()) {
      // A letter that looks like 0, or a unit.
      id += holds("o", token.text) ? "0" : "";
      sure = false;
    } else if (!name.empty() && (in == In::Id || repair::is_called("", token.text))) {
      continue; // `id is 41`
    } else if (in == In::Flags || in == In::More ||
               (!name.empty() && spec::find_macro_flag(token.text) != nullptr)) {
      const auto* flag = flag_called(token.text);
      const bool none = repair::is_called("off", token.text);
      const auto word = none ? std::string_view("none") : flag != nullptr ? flag->word : "";
      if (word.empty() && in == In::Flags)
        return {};
      sure = sure && (none || word == token.text);
      if (!word.empty() && std::find(flags.begin(), flags.end(), word) == flags.end())
        flags.push_back(word);
    } else {
      name += (name.empty() ? "" : "_") + plain_name(token.text);
    }
  }
  if (name.empty() || (says_id && id.empty()))
    return {};
  std::vector<std::string> ways; // possible readings of the id
  if (const auto hex = hexadecimal(id); id.empty() || (hex && *hex <= UINT8_MAX))
    ways.push_back(id);
  for (const int base : {10, 16})
    if (const auto byte = parse_number<int>(id, base);
        byte && *byte <= UINT8_MAX && (base == 10 || marked) &&
        (*byte >= spec::macro_id_user_first || (sure && !marked)))
      ways.push_back(std::to_string(*byte));
  if (ways.empty())
    return {};
  const auto written = [&](std::string_view number) {
    auto text = ".macro " + name + (number.empty() ? "" : " id=") + std::string(number);
    for (std::size_t i = 0; i < flags.size(); ++i)
      text += fmt::format("{}{}", i == 0 ? " flags=" : ",", flags[i]);
    return text;
  };
  return {{written(ways[0]), sure && !marked, ways.size() > 1 ? written(ways[1]) : ""}};
}

/// Reads `.const NAME = 100`.
std::vector<Rephrased> rephrase_constant(Tokens line, const repair::Quantities& constants) {
  if (line.size() > 4 && line[1].is_word() && line[2].is_word()) // `const int step = 500`
    line.erase(line.begin() + 1);
  const std::size_t at = line.size() > 2 && (line[2].is("=") || line[2].is(":")) ? 3 : 2;
  if (line.size() <= at || !line[1].is_word())
    return {};
  const auto value = repair::slice(line, at);
  const auto part = repair::quantity_of(value, constants);
  if (part && part->measure == Measure::Percent) { // of a speed or a brightness
    constexpr std::int64_t hundred = 100 * whole;  // percent
    return {{fmt::format(".const {} = {}", line[1].text,
                         (part->thousandths * UINT8_MAX + hundred / 2) / hundred),
             false}};
  }
  const auto known = repair::compute(value, constants);
  return known ? std::vector<Rephrased>{{fmt::format(".const {} = {}", line[1].text, *known)}}
               : std::vector<Rephrased>();
}

// ---- commands

struct Command {
  const MacroCommandInfo* info = nullptr;
  Tokens values;
  bool sure = true;
};

/// A part of a word of a line.
struct Part {
  std::string text;
  std::string means; ///< its English meaning
  std::size_t token = 0;
};

bool says_nothing(const Part& part) {
  return repair::is_called("", part.text) || repair::is_called("set", part.text);
}

/// True if a word can denote a part of a mnemonic: `warte` for `wait`, `stopp` for `stopped`.
bool stands_for(const Part& said, const std::string& part) {
  constexpr std::size_t stem = 4;   // letters
  constexpr std::size_t little = 2; // such as `on`
  return said.text == part || said.means == part || repair::is_called(part, said.text) ||
         (std::min(said.text.size(), part.size()) >= stem &&
          (part.starts_with(said.text) || said.text.starts_with(part))) ||
         (part.size() == little && said.text.size() <= little + 1 && is_letter(said.text[0]));
}

/// Finds a mnemonic by its spelling or by a common name.
const MacroCommandInfo* command_called(const std::string& words) {
  const auto bare = [](std::string_view word) {
    std::string letters(word);
    std::erase(letters, '_');
    return letters;
  };
  for (const auto& info : spec::macro_commands)
    if (bare(info.mnemonic) == bare(words))
      return &info;
  for (const auto& called : {words, bare(words)})
    for (const auto meaning : repair::meanings_of(called))
      if (const auto* info = spec::find_macro_command(meaning))
        return info;
  return nullptr;
}

/// Splits the words of a line into parts; includes the number of `set_sd 2`.
std::vector<Part> parts_of_words(const Tokens& line) {
  constexpr std::size_t most = 8;
  std::vector<Part> parts;
  for (std::size_t i = 0; i < line.size() && parts.size() < most; ++i) {
    if (line[i].is_word())
      for (auto& text : repair::parts_of(line[i].text))
        if (!text.empty())
          parts.push_back({text, repair::word_at({repair::word(text)}, 0), i});
    if (line[i].is_number() && i == 1 && parts.size() > 1)
      parts.push_back({line[i].text, line[i].text, i});
  }
  parts.resize(std::min(parts.size(), most));
  return parts;
}

/// Finds the command that matches most of the first words of a line: joined or apart, in any
/// language. Returns none on a tie.
Command command_of(const Tokens& line) {
  const auto parts = parts_of_words(line);
  const MacroCommandInfo* best = nullptr;
  std::uint32_t best_used = 0; // one bit per part
  bool sure = true;
  bool tied = false;
  enum class By : std::uint8_t { Name, Parts };
  // True if every used word is used whole and the words before it mean nothing.
  const auto leaves_nothing = [&](std::uint32_t used) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const bool is_used = (used >> i & 1U) != 0;
      bool needed = used >> i != 0 && (used & ((1U << i) - 1U)) == 0; // before the first
      for (std::size_t other = 0; other < parts.size(); ++other)
        needed = needed || ((used >> other & 1U) != 0 && parts[other].token == parts[i].token);
      if (needed && !is_used && !says_nothing(parts[i]))
        return false;
    }
    return true;
  };
  const auto take = [&](const MacroCommandInfo* info, std::uint32_t used, By by) {
    const auto more = std::popcount(used) - std::popcount(best_used);
    if (info == nullptr || info == best || more < 0 || !leaves_nothing(used))
      return;
    if (more == 0 && best != nullptr) {
      tied = tied || (by == By::Name) == sure;
      return;
    }
    best = info;
    best_used = used;
    sure = by == By::Name;
    tied = false;
  };
  const auto first_value = std::find_if(line.begin(), line.end(), [](const Token& token) {
    return token.is_number() || token.is("=");
  });
  const auto heads =
      static_cast<std::size_t>(std::count_if(parts.begin(), parts.end(), [&](const Part& part) {
        return part.token <= static_cast<std::size_t>(first_value - line.begin());
      }));
  for (std::size_t from = 0; from < heads; ++from) {
    std::string words;
    for (auto end = from; end < heads; ++end) {
      words += (words.empty() ? "" : "_") + parts[end].text;
      take(command_called(words), ((2U << end) - 1U) & ~((1U << from) - 1U), By::Name);
    }
    if (!says_nothing(parts[from]))
      break;
  }
  for (const auto& info : spec::macro_commands) {
    const auto named = repair::parts_of(info.mnemonic);
    std::uint32_t used = 0;
    for (const auto& part : named)
      for (std::size_t i = 0; i < parts.size(); ++i)
        if ((used >> i & 1U) == 0 && stands_for(parts[i], part)) {
          used |= 1U << i;
          break;
        }
    if (named.size() > 1 && std::popcount(used) == static_cast<int>(named.size()))
      take(&info, used, By::Parts);
  }
  if (best == nullptr || tied)
    return {};
  Tokens values;
  std::size_t last = 0;
  std::set<std::size_t> used;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if ((best_used >> i & 1U) != 0)
      used.insert(last = parts[i].token);
  for (auto i = *used.begin(); i < line.size(); ++i)
    if (!used.contains(i) && (i > last || line[i].is_word()))
      values.push_back(line[i]);
  return {best, std::move(values), sure};
}

Operand operand_of(const spec::MacroOperand& row) {
  constexpr int tick = 10; // ms
  Operand operand;
  operand.name = row.name;
  operand.counts = row.kind == MacroOperandKind::MacroId ? Counts::Name
                   : row.unit == MacroUnit::Degrees      ? Counts::Degrees
                   : row.unit != MacroUnit::None         ? Counts::Milliseconds
                   : holds("red green blue", row.name)   ? Counts::Channel
                   : row.name == "speed"                 ? Counts::Speed
                                                         : Counts::Plain;
  operand.least = row.minimum;
  operand.most = row.maximum * (row.unit == MacroUnit::Ticks10ms ? tick : 1);
  operand.optional = row.kind == MacroOperandKind::Delay;
  for (const auto* word = row.begin_words(); word != row.end_words(); ++word)
    operand.words.push_back(word->word);
  if (operand.counts == Counts::Degrees && operand.least >= 0)
    operand.words = {"0", "90", "180", "270"};
  if (operand.counts <= Counts::Speed && operand.most == UINT8_MAX)
    operand.words.push_back("255");
  return operand;
}

/// Splits bytes written without a space, if only one split is valid: `rgb 0 255120`. Returns true
/// if it split any.
bool part_bytes(Tokens& values, const std::vector<Operand>& operands) {
  std::ptrdiff_t wanted = 0;
  for (const auto& operand : operands) {
    if (!operand.optional && (operand.counts > Counts::Speed || operand.most != UINT8_MAX))
      return false;
    wanted += operand.optional ? 0 : 1;
  }
  const auto byte = [](std::string_view digits) {
    const bool padded = digits.size() > 1 && digits[0] == '0';
    return !padded && parse_number<int>(digits).value_or(UINT16_MAX) <= UINT8_MAX;
  };
  if (std::count_if(values.begin(), values.end(), std::mem_fn(&Token::is_number)) + 1 != wanted)
    return false;
  for (auto value = values.begin(); value != values.end(); ++value) {
    const std::string text = value->text;
    std::vector<std::size_t> places;
    for (std::size_t at = 1; at < text.size() && value->is_number() && !byte(text); ++at)
      if (byte(text.substr(0, at)) && byte(text.substr(at)))
        places.push_back(at);
    if (places.size() != 1)
      continue;
    value->text.resize(places[0]);
    values.insert(value + 1, Token{Token::Kind::Number, text.substr(places[0]), true});
    return true;
  }
  return false;
}

/// The lines that wait this long; empty if they would be too many.
std::string delays(const std::string& time) {
  constexpr std::int64_t most_lines = 9;
  const auto& delay = spec::info(MacroCommand::Delay);
  const auto value = repair::quantity_of(repair::tokens_of(time, repair::Language::Macro), {});
  const auto ms = value ? value->thousandths / whole : -1;
  const std::int64_t most = delay.operand[0].maximum;
  const auto lines = std::max<std::int64_t>((ms + most - 1) / most, 1);
  if (lines == 1 && ms >= 0)
    return fmt::format("{} {}", delay.mnemonic, time);
  if (ms < 0 || lines > most_lines)
    return {};
  std::string all;
  for (std::int64_t i = 0; i < lines; ++i)
    all += fmt::format("{}{} {}", i == 0 ? "" : "\n", delay.mnemonic,
                       time_text(ms / lines + (i + 1 == lines ? ms % lines : 0)));
  return all;
}

std::vector<Rephrased> rephrase_command(const Command& command, const Tokens& written,
                                        const repair::Quantities& constants) {
  if (command.info->variable_length)
    return command.values.size() == 1 && command.values[0].is_text()
               ? std::vector<Rephrased>{{fmt::format("{} \"{}\"", command.info->mnemonic,
                                                     command.values[0].text)}}
               : std::vector<Rephrased>();
  const bool rolls = command.info->command == MacroCommand::Roll;
  std::vector<Operand> operands; // a longer delay makes a roll a roll2
  for (const auto& row : rolls ? spec::info(MacroCommand::Roll2) : *command.info)
    operands.push_back(operand_of(row));
  auto values = command.values;
  const bool names = operands.size() == 1 && operands[0].counts == Counts::Name;
  if (values.size() > 1) // `on_collision: jmp ahead`, `loop_start: mov 8`
    std::erase_if(values, [&](const Token& token) {
      const auto jumps = [&](std::string_view word) {
        return names && (token.is(word) || repair::is_called(word, token.text));
      };
      return token.is_word() &&
             (repair::is_called("set", token.text) || jumps("goto") || jumps("gosub"));
    });
  for (auto& token : values)
    if (names)
      token.text = plain_name(token.text);
  bool guessed = part_bytes(values, operands);
  auto found = repair::arrange(values, operands, constants);
  for (std::size_t i = 1; i < values.size() && !found; ++i) { // `delay 60 60`: typed twice
    if (!values[i].is_number() || values[i].text != values[i - 1].text)
      continue;
    auto once = values;
    repair::take_out(once, i - 1, 1);
    found = repair::arrange(once, operands, constants);
    guessed = true;
  }
  if (!found)
    return {};
  if (command.info->command == MacroCommand::Delay)
    if (auto lines = delays(found->values[0]); lines.find('\n') != std::string::npos)
      return {{std::move(lines), command.sure && !is_digit(found->values[0].back())}};
  // Keep the names if every value has one, else only those of optional operands.
  bool all_named = true;
  for (std::size_t i = 0; i < operands.size(); ++i)
    all_named = all_named && (found->values[i].empty() || found->named[i]);
  const bool calls = repair::has_token(written, "(");
  bool sure = found->sure && command.sure && !guessed;
  const auto text_of = [&](const std::vector<std::string>& all) {
    std::string text(command.info->mnemonic);
    const auto* between = " ";
    for (std::size_t i = 0; i < operands.size(); ++i) {
      if (all[i].empty())
        continue;
      constexpr int most_seconds = 20; // limit for a time without a unit in a call, which means
                                       // seconds, as in Python
      const auto number = parse_number<int>(all[i]);
      const bool seconds = calls && number && *number > 0 && *number <= most_seconds &&
                           operands[i].counts == Counts::Milliseconds;
      sure = sure && !seconds;
      text += between;
      if (all_named || (operands[i].optional && found->named[i]))
        text += fmt::format("{}=", operands[i].name);
      text += all[i] + (seconds ? "s" : "");
      between = repair::has_token(written, ",") ? ", " : " ";
    }
    return text;
  };
  auto text = text_of(found->values);
  // In `roll(0, 100)` the author may mean the heading first, as in other interfaces.
  if (rolls && calls && !found->named[0] && !found->named[1] && found->wait.empty() &&
      found->values[0] != found->values[1]) {
    auto exchanged = found->values;
    std::swap(exchanged[0], exchanged[1]);
    return {{std::move(text), false, text_of(exchanged)}};
  }
  if (found->wait.empty())
    return {{std::move(text), sure}};
  const auto lines = delays(found->wait);
  return lines.empty()
             ? std::vector<Rephrased>()
             : std::vector<Rephrased>{{text + "\n" + lines, sure && !is_digit(found->wait.back())}};
}

} // namespace

SurroundingText read_surroundings(std::string_view text) {
  SurroundingText found;
  while (!text.empty()) {
    const auto end = std::min(text.find_first_of("\r\n"), text.size());
    const auto line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.size() > longest_constant)
      continue;
    const auto tokens = repair::split(line, repair::Language::Macro).tokens;
    if (tokens.size() > 1 && tokens[0].is(".const"))
      found.names.push_back(tokens[1].text);
    if (tokens.size() > 3 && tokens[0].is(".const") && tokens[2].is("="))
      if (const auto value = repair::quantity_of(repair::slice(tokens, 3), found.constants))
        found.constants.emplace(tokens[1].text, *value);
    if (tokens.size() > 1 && tokens[0].is(".macro") && tokens[1].is_word())
      found.macros.push_back(tokens[1].text);
  }
  return found;
}

std::vector<Rephrased> rephrase(const Tokens& written, const SurroundingText& elsewhere) {
  auto line = written;
  for (const auto& one : rewrites())
    if (!line.empty())
      one.apply(line);
  if (line.empty() || !line[0].is_word())
    return {};
  if (line[0].is(".macro"))
    return rephrase_header(line);
  const auto first = std::string_view(line[0].text).substr(line[0].text[0] == '.' ? 1 : 0);
  if (repair::is_called(".const", first))
    return rephrase_constant(std::move(line), elsewhere.constants);
  auto command = command_of(line);
  if (command.info == &spec::info(MacroCommand::Sleep)) { // elsewhere it is a wait
    if (command.values.size() != 1 || !elsewhere.constants.contains(command.values[0].text))
      return {};
    command = {&spec::info(MacroCommand::Delay), std::move(command.values), false};
  }
  if (command.info != nullptr)
    return rephrase_command(command, written, elsewhere.constants);
  // `step`, `aufruf step`
  const bool known = repair::is_known_word(line[0].text, repair::Where::Line);
  if (line.size() > 2 || (line.size() == 1 && known) ||
      std::find(elsewhere.macros.begin(), elsewhere.macros.end(), line.back().text) ==
          elsewhere.macros.end())
    return {};
  return {{fmt::format("{} {}", spec::info(MacroCommand::Gosub).mnemonic, line.back().text),
           line.size() == 1}};
}

} // namespace orb::assembler
