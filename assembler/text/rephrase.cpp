#include "assembler/text/rephrase.h"

#include "assembler/text/program.h"

#include "base/duration.h"
#include "base/text/text.h"
#include "repair/arrange.h"
#include "repair/idioms.h"
#include "repair/tokens.h"
#include "spec/macro.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace orb::assembler {
namespace {

using repair::Counts;
using repair::Measure;
using repair::Operand;
using repair::Quantities;
using repair::Rephrased;
using repair::Token;
using repair::Tokens;
using spec::MacroOperandKind;
using spec::MacroUnit;

constexpr std::size_t longest_constant = 240; // bytes; nobody writes longer constants

Operand operand_of(const spec::MacroOperand& row) {
  Operand operand;
  operand.name = row.name;
  operand.counts = row.kind == MacroOperandKind::MacroId ? Counts::Name
                   : row.unit == MacroUnit::Degrees      ? Counts::Degrees
                   : row.unit == MacroUnit::None         ? Counts::Plain
                                                         : Counts::Milliseconds;
  operand.least = row.minimum;
  operand.most = row.maximum;
  operand.optional = row.kind == MacroOperandKind::Delay;
  for (const auto* word = row.begin_words(); word != row.end_words(); ++word)
    operand.words.push_back(word->word);
  if (operand.name == "heading")
    operand.words = {"0", "90", "180", "270"};
  if (operand.name == "count" || operand.name == "speed")
    operand.words = {"255"};
  return operand;
}

Tokens after(const Tokens& line, std::size_t begin) {
  return {line.begin() + static_cast<std::ptrdiff_t>(std::min(begin, line.size())), line.end()};
}

std::optional<std::int64_t> milliseconds(const std::string& text) {
  const auto value = repair::quantity_of(repair::tokens_of(text, repair::Language::Macro), {});
  return value && value->thousandths % whole == 0 && value->thousandths >= 0
             ? std::optional(value->thousandths / whole)
             : std::nullopt;
}

std::string delays(const std::string& time) {
  const auto ms = milliseconds(time);
  const auto waits = ms ? waits_of(*ms) : std::vector<std::int64_t>();
  const auto word = spec::info(spec::MacroCommand::Delay).mnemonic;
  if (waits.size() == 1)
    return fmt::format("{} {}", word, time);
  std::string all;
  for (const auto wait : waits)
    all += fmt::format("{}{} {}", all.empty() ? "" : "\n", word, time_text(wait));
  return all;
}

/// What is taken where an operand lacks and one value is the clear one.
std::string_view usual_of(const spec::MacroCommandInfo& info, const Operand& operand,
                          const Elsewhere& elsewhere) {
  const auto as_elsewhere = elsewhere.times.find(info.mnemonic);
  const bool lasts = info.background != spec::MacroBackground::None ||
                     info.command == spec::MacroCommand::WaitUntilStopped;
  if (lasts && operand.counts == Counts::Milliseconds && as_elsewhere != elsewhere.times.end() &&
      milliseconds(as_elsewhere->second))
    return as_elsewhere->second;
  if (info.background != spec::MacroBackground::None && operand.name == "time")
    return "1s";
  if (info.command == spec::MacroCommand::WaitUntilStopped)
    return "5s";
  return info.command == spec::MacroCommand::Stabilization && operand.name == "mode" ? "on" : "";
}

/// `left 90` and `back 90` turn by -90.
void turn_left(Tokens& values) {
  bool left = false;
  std::erase_if(values, [&](const Token& token) {
    const bool to_left = token.is_word() && (repair::is_called("270", token.text) ||
                                             repair::is_called("180", token.text));
    left = left || to_left;
    return to_left || (token.is_word() && repair::is_called("90", token.text));
  });
  for (auto& token : values)
    if (left && token.is_number()) {
      token.text.insert(0, "-");
      return;
    }
}

/// `1,5s` is `1.5s`, and `1,000` is `1000`.
void join_decimals(Tokens& values) {
  if (values.size() < 3 || !values[0].is_number() || !values[1].is(",") || !values[2].is_number() ||
      values[2].gap)
    return;
  constexpr std::size_t thousand = 3; // digits
  const bool thousands = values.size() == 3 && values[2].text.size() == thousand;
  values[0].text += (thousands ? "" : ".") + values[2].text;
  values.erase(values.begin() + 1, values.begin() + 3);
}

/// `100 -100` are powers of both motors: forward and reverse.
void say_modes(Tokens& values) {
  Tokens said;
  std::size_t powers = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool back = values[i].is("-") && i + 1 < values.size() && values[i + 1].is_number();
    i += back ? 1 : 0;
    const bool timed = i + 1 < values.size() && values[i + 1].is_word() && !values[i + 1].gap;
    if (values[i].is(","))
      continue;
    if (!values[i].is_number())
      return;
    if (timed)
      break;
    said.push_back(Token{Token::Kind::Word, back ? "reverse" : "forward", true});
    said.push_back(values[i]);
    ++powers;
  }
  if (powers == 2)
    values = said;
}

/// Letters that names do not have, and what stands for them.
constexpr auto letters = std::to_array<std::pair<std::string_view, std::string_view>>(
    {{"ä", "ae"}, {"ö", "oe"}, {"ü", "ue"}, {"Ä", "Ae"}, {"Ö", "Oe"}, {"Ü", "Ue"}, {"ß", "ss"},
     {"á", "a"},  {"à", "a"},  {"â", "a"},  {"ã", "a"},  {"é", "e"},  {"è", "e"},  {"ê", "e"},
     {"ë", "e"},  {"í", "i"},  {"ì", "i"},  {"î", "i"},  {"ï", "i"},  {"ó", "o"},  {"ò", "o"},
     {"ô", "o"},  {"õ", "o"},  {"ú", "u"},  {"ù", "u"},  {"û", "u"},  {"ñ", "n"},  {"ç", "c"}});

std::string without_accents(std::string text) {
  for (const auto& [letter, plain] : letters)
    for (auto at = text.find(letter); at != std::string::npos; at = text.find(letter, at))
      text.replace(at, letter.size(), plain);
  return text;
}

/// A name in the letters that names have: `grün` is `gruen`, `my-name` is `my_name`.
std::string plain_name(const Tokens& tokens) {
  std::string name;
  for (const auto& token : tokens)
    for (const auto& part : repair::tokens_of(token.text, repair::Language::Macro))
      if (part.is_word() || part.is_number())
        name += (name.empty() ? "" : "_") + without_accents(part.text);
  std::erase_if(name, [](char c) { return !is_letter(c) && !is_digit(c) && c != '_'; });
  return name.empty() || !is_digit(name[0]) ? name : "m" + name;
}

/// `jmp`, `goto`: words of which the command already says all.
bool is_jump(const Token& token) {
  constexpr auto words = std::to_array<std::string_view>(
      {"jmp", "goto", "jump", "call", "gosub", "run", "do", "go", "to", "bra", "br", "jsr"});
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return equal_words(word, token.text); });
}

/// `rgb 0 255120`: two bytes side by side, where only one way parts them.
void part_bytes(Tokens& values, std::size_t wanted) {
  const auto numbers = std::count_if(values.begin(), values.end(),
                                     [](const Token& token) { return token.is_number(); });
  if (static_cast<std::size_t>(numbers) + 1 != wanted)
    return;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto text = values[i].text;
    if (!values[i].is_number() || parse_number<int>(text).value_or(0) <= UINT8_MAX)
      continue;
    std::size_t place = 0;
    for (std::size_t at = 1; at < text.size(); ++at) {
      const auto left = parse_number<int>(std::string_view(text).substr(0, at));
      const auto right = parse_number<int>(std::string_view(text).substr(at));
      const bool padded = text[at] == '0' && at + 1 < text.size();
      if (!left || !right || *left > UINT8_MAX || *right > UINT8_MAX || padded)
        continue;
      if (place != 0)
        return; // more than one
      place = at;
    }
    if (place == 0)
      return;
    auto second = values[i];
    values[i].text = text.substr(0, place);
    second.text = text.substr(place);
    second.gap = true;
    values.insert(values.begin() + static_cast<std::ptrdiff_t>(i) + 1, second);
    return;
  }
}

/// `mov`, `please`: words before a command that add nothing.
bool is_move(const Token& token) {
  constexpr auto words = std::to_array<std::string_view>(
      {"mov", "ld",    "ldi",    "lda", "li",   "move", "set",   "do",  "turn",
       "let", "make",  "please", "now", "then", "the",  "my",    "put", "use",
       "run", "start", "db",     "cmd", "out",  "call", "change"});
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return equal_words(word, token.text); });
}

std::vector<Rephrased> rephrase_command(const spec::MacroCommandInfo& info, const Tokens& line,
                                        const Elsewhere& elsewhere) {
  auto operands = std::vector<Operand>();
  for (const auto& row : info) {
    if (row.kind == MacroOperandKind::Text)
      return {};
    operands.push_back(operand_of(row));
  }
  if (info.command == spec::MacroCommand::Sleep)
    return {}; // elsewhere it is a wait
  if (info.command == spec::MacroCommand::Roll && line.size() > 1 && line[1].is("("))
    return {}; // a function of another language, with the heading first
  for (auto& operand : operands)
    operand.usual = usual_of(info, operand, elsewhere);
  Tokens values = after(line, 1);
  if (spec::MacroBackground::Rotate == info.background)
    turn_left(values);
  if (info.command == spec::MacroCommand::RawMotors)
    say_modes(values);
  if (operands.size() == 1 && operands[0].counts == Counts::Milliseconds)
    join_decimals(values);
  if (operands.size() == 1 && operands[0].counts == Counts::Name && values.size() > 1)
    std::erase_if(values, [](const Token& token) { return token.is(":") || is_jump(token); });
  if (operands.size() == 1 && operands[0].counts == Counts::Name)
    for (auto& token : values)
      if (token.is_word() || token.is_text())
        token = Token{Token::Kind::Word, plain_name({token}), token.gap};
  if (std::all_of(operands.begin(), operands.end(), [](const Operand& operand) {
        return operand.counts == Counts::Plain && operand.most == UINT8_MAX;
      }))
    part_bytes(values, operands.size());
  if (info.command == spec::MacroCommand::Roll) // a longer delay makes it a roll2
    operands.back().most = UINT16_MAX;
  const auto arranged = repair::arrange(values, operands, elsewhere.constants);
  if (!arranged)
    return {};
  if (info.command == spec::MacroCommand::Delay)
    if (const auto ms = milliseconds(arranged->values[0]); ms && *ms > UINT16_MAX)
      return {{delays(arranged->values[0]), true}};
  // Names stay where they can: none may be left out before one that has none.
  bool all_named = true;
  for (std::size_t i = 0; i < operands.size(); ++i)
    all_named = all_named && (arranged->values[i].empty() || arranged->named[i]);
  const bool commas =
      std::any_of(line.begin(), line.end(), [](const Token& token) { return token.is(","); });
  std::string text(info.mnemonic);
  bool first = true;
  bool in_seconds = false;
  for (std::size_t i = 0; i < operands.size(); ++i) {
    if (arranged->values[i].empty())
      continue;
    constexpr int most_seconds = 20; // of a time without a unit in a call, as Python writes them
    const auto& value = arranged->values[i];
    const auto number = parse_number<int>(value);
    const bool seconds = line.size() > 1 && line[1].is("(") && number && *number > 0 &&
                         *number <= most_seconds && operands[i].counts == Counts::Milliseconds;
    in_seconds = in_seconds || seconds;
    text += first || !commas ? " " : ", ";
    first = false;
    if (all_named || (operands[i].optional && arranged->named[i]))
      text += fmt::format("{}=", operands[i].name);
    text += value + (seconds ? "s" : "");
  }
  if (arranged->wait.empty())
    return {{text, arranged->sure && !in_seconds}};
  const auto waits = delays(arranged->wait);
  return waits.empty() ? std::vector<Rephrased>()
                       : std::vector<Rephrased>{{text + "\n" + waits, arranged->sure}};
}

/// `.macro NAME id=40 flags=motor_control`, with its parts in any order.
std::vector<Rephrased> rephrase_header(const Tokens& line) {
  Tokens name;
  std::string id;
  std::vector<std::string> flags;
  enum class In : std::uint8_t { Name, Id, Flags } in = In::Name;
  Tokens flag;
  const auto end_flag = [&] {
    if (flag.empty())
      return true;
    std::string joined;
    for (const auto& token : flag)
      joined += token.text;
    std::erase_if(joined, [](char c) { return c == '_' || c == '-'; });
    for (const auto& row : spec::macro_flags) {
      std::string bare(row.word);
      std::erase(bare, '_');
      if (equal_words(bare, joined)) {
        flags.emplace_back(row.word);
        flag.clear();
        return true;
      }
    }
    return false;
  };
  const bool says_id = std::any_of(
      line.begin(), line.end(), [](const Token& token) { return equal_words(token.text, "id"); });
  for (std::size_t i = 1; i < line.size(); ++i) {
    const auto& token = line[i];
    if (token.is("=") || token.is(":") || token.is("(") || token.is(")"))
      continue;
    const bool labels =
        token.is("name") && i + 1 < line.size() && (line[i + 1].is(":") || line[i + 1].is("="));
    if (labels ||
        (!name.empty() && in == In::Name && token.is_word() && repair::is_called("", token.text)))
      continue;
    if (i + 1 < line.size() && !name.empty() && in == In::Name && token.is_word() &&
        line[i + 1].is_word())
      if (const auto* known =
              spec::find_macro_flag(lower(token.text) + "_" + lower(line[i + 1].text))) {
        flags.emplace_back(known->word); // `motor control`
        ++i;
        continue;
      }
    if (says_id && in == In::Name && !name.empty() && token.is_number() && token.gap) {
      i += i + 1 < line.size() && line[i + 1].is_word() && !line[i + 1].gap ? 1 : 0;
      continue; // `spin 12s id=53`
    }
    // `numero=40` and `options=endsig`: what is given says what it is.
    const bool given = !name.empty() && i + 2 < line.size() && line[i + 1].is("=");
    const bool is_id = equal_words(token.text, "id") || equal_words(token.text, "number") ||
                       (given && line[i + 2].is_number());
    const bool is_flags = equal_words(token.text, "flags") || equal_words(token.text, "flag") ||
                          (given && line[i + 2].is_word());
    if (token.is_word() && (is_id || is_flags)) {
      if (!end_flag())
        return {};
      in = is_id ? In::Id : In::Flags;
    } else if (in == In::Id && id.empty()) {
      id = token.text;
      in = In::Name;
      const bool unit = i + 1 < line.size() && !line[i + 1].gap && line[i + 1].is_word() &&
                        line[i + 1].text.size() > 1;
      i += unit ? 1 : 0; // `id=64deg`
      if (i + 1 < line.size() && !line[i + 1].gap && (line[i + 1].is("O") || line[i + 1].is("o"))) {
        id += '0'; // a letter that looks like a digit
        ++i;
      }
    } else if (in == In::Flags &&
               (token.is(",") || token.is("|") || token.is("+") || token.is("and"))) {
      if (!end_flag())
        return {};
    } else if (in == In::Flags) {
      if (token.gap && !flag.empty() && end_flag())
        flag.clear();
      flag.push_back(token);
    } else if (const auto* known = spec::find_macro_flag(lower(token.text));
               known != nullptr && !name.empty()) {
      flags.emplace_back(known->word);
    } else if (!token.is(",")) {
      const bool apart = token.gap || line[i - 1].is("(");
      if (token.is_number() && id.empty() && !name.empty() && apart)
        id = token.text;
      else
        name.push_back(token);
    }
  }
  if (!end_flag() || name.empty())
    return {};
  const auto plain = plain_name(name);
  if (plain.empty())
    return {};
  auto text = ".macro " + plain;
  if (!id.empty())
    text += " id=" + id;
  for (std::size_t i = 0; i < flags.size(); ++i)
    text += (i == 0 ? " flags=" : ",") + flags[i];
  return {{text, true}};
}

} // namespace

Elsewhere look_elsewhere(std::string_view text) {
  Elsewhere found;
  while (!text.empty()) {
    const auto end = std::min(text.find_first_of("\r\n"), text.size());
    const auto line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.size() > longest_constant)
      continue;
    const auto tokens = repair::split(line, repair::Language::Macro).tokens;
    if (tokens.size() > 3 && tokens[0].is(".const") && tokens[2].is("="))
      if (const auto value = repair::quantity_of(after(tokens, 3), found.constants))
        found.constants.emplace(tokens[1].text, *value);
    if (tokens.size() > 2 && tokens.back().is_word() && tokens[tokens.size() - 2].is_number())
      found.times.insert_or_assign(tokens[0].text,
                                   tokens[tokens.size() - 2].text + tokens.back().text);
  }
  return found;
}

std::vector<std::int64_t> waits_of(std::int64_t ms) {
  constexpr std::int64_t most_lines = 9;
  const std::int64_t most = spec::info(spec::MacroCommand::Delay).operand[0].maximum;
  const auto lines = std::max<std::int64_t>((ms + most - 1) / most, 1);
  if (ms < 0 || lines > most_lines)
    return {};
  std::vector<std::int64_t> waits(static_cast<std::size_t>(lines), ms / lines);
  waits.back() += ms % lines;
  return waits;
}

namespace {

/// `loop-start` and `loop start` are one word.
Tokens joined(const Tokens& line) {
  for (const std::size_t size : {3U, 2U}) {
    if (line.size() < size || !line[0].is_word() || !line[size - 1].is_word() ||
        (size == 3 && (!line[1].is("-") || line[2].gap)))
      continue;
    const auto word = line[0].text + "_" + line[size - 1].text;
    if (spec::find_macro_command(word) == nullptr)
      continue;
    auto all = after(line, size - 1);
    all[0].text = word;
    return all;
  }
  if (line.size() > 2 && line[1].is_number() && line[0].is_word() && // `set_sd 2 70`
      spec::find_macro_command(line[0].text + line[1].text) != nullptr) {
    auto all = after(line, 1);
    all[0] = Token{Token::Kind::Word, line[0].text + line[1].text};
    return all;
  }
  return line;
}

/// Whether a word can stand for a part of a mnemonic: `warte` for `wait`, `stopp` for `stopped`.
bool stands_for(const std::string& word, const std::string& part) {
  constexpr std::size_t stem = 3; // letters
  constexpr std::size_t little = 2;
  const auto translated = repair::word_at(repair::tokens_of(word, repair::Language::Macro), 0);
  return word == part || translated == part || repair::is_called(part, word) ||
         (word.size() >= stem && part.size() >= stem &&
          (word.starts_with(part) || part.starts_with(word))) ||
         (part.size() <= little && word.size() <= little + 1 && !is_digit(word[0]));
}

/// The command whose mnemonic a word has part for part: `warte_bis_stopp`.
const spec::MacroCommandInfo* command_in_parts(std::string_view word) {
  const auto said = repair::parts_of(word);
  if (said.size() < 2)
    return nullptr;
  const spec::MacroCommandInfo* found = nullptr;
  for (const auto& info : spec::macro_commands) {
    const auto parts = repair::parts_of(info.mnemonic);
    if (!std::equal(said.begin(), said.end(), parts.begin(), parts.end(), stands_for))
      continue;
    if (found != nullptr)
      return nullptr;
    found = &info;
  }
  return found;
}

/// The command whose mnemonic's parts all stand in the line, those before its values first: `roll
/// with spd1 and sd1 to 315`. They are taken out.
const spec::MacroCommandInfo* command_among(Tokens& line) {
  const auto place = [&](const std::string& part) {
    return std::find_if(line.begin(), line.end(), [&](const Token& token) {
      return token.is_word() && equal_words(token.text, part);
    });
  };
  const spec::MacroCommandInfo* found = nullptr;
  std::size_t most = 1;
  for (const auto& info : spec::macro_commands) {
    const auto parts = repair::parts_of(info.mnemonic);
    if (parts.size() > most &&
        std::all_of(parts.begin(), parts.end(),
                    [&](const std::string& part) { return place(part) != line.end(); })) {
      found = &info;
      most = parts.size();
    }
  }
  if (found != nullptr)
    for (const auto& part : repair::parts_of(found->mnemonic))
      line.erase(place(part));
  return found;
}

const spec::MacroCommandInfo* command_called(const Token& token) {
  const auto* info = spec::find_macro_command(token.text);
  if (info == nullptr && token.text.starts_with('.'))
    info = spec::find_macro_command(std::string_view(token.text).substr(1));
  for (const auto name : repair::meanings_of(token.text))
    info = info == nullptr ? spec::find_macro_command(name) : info;
  for (const auto& one : spec::macro_commands) { // `rotationrate`
    std::string bare(one.mnemonic);
    std::erase(bare, '_');
    info = info == nullptr && equal_words(bare, token.text) ? &one : info;
  }
  return info == nullptr ? command_in_parts(token.text) : info;
}

/// The command that a line means, which then is its first word.
const spec::MacroCommandInfo* command_of(Tokens& line) {
  auto rest = line;
  const auto* among = command_among(rest);
  constexpr std::size_t several = 3; // parts
  const bool surely = among != nullptr && (repair::parts_of(among->mnemonic).size() >= several ||
                                           spec::find_macro_command(line[0].text) != nullptr);
  if (spec::find_macro_command(line[0].text) != nullptr && !surely)
    return spec::find_macro_command(line[0].text);
  if (among != nullptr) {
    rest.insert(rest.begin(), Token{Token::Kind::Word, std::string(among->mnemonic)});
    line = rest;
    return among;
  }
  constexpr std::size_t most = 2; // words before it: `mov rgb`, `turn the rgb`
  for (std::size_t i = 1; i <= most && i < line.size() && line[i].is_word() && is_move(line[i - 1]);
       ++i)
    if (const auto* info = command_called(line[i]); info != nullptr && !is_move(line[i])) {
      line.erase(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(i));
      return info;
    }
  return command_called(line[0]);
}

/// `80h`, `0C8h`, `0xFEh` and `$FF` in decimal.
void read_hexadecimal(Tokens& line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    std::string digits = line[i].text;
    std::size_t used = 1;
    if (line[i].is("$") && i + 1 < line.size() && !line[i + 1].gap) {
      digits = line[i + 1].text;
      used = 2;
    } else if (!line[i].is_number()) {
      continue;
    } else if (i + 1 < line.size() && line[i + 1].is_word() && !line[i + 1].gap &&
               to_lower(line[i + 1].text.back()) == 'h') {
      digits += line[i + 1].text;
      digits.pop_back();
      used = 2;
    } else if (digits.size() > 2 && to_lower(digits[1]) == 'x' && to_lower(digits.back()) == 'h') {
      digits = digits.substr(2, digits.size() - 3);
    } else {
      continue;
    }
    const auto value = parse_number<std::uint32_t>(digits, 16);
    if (!value)
      continue;
    const bool gap = line[i].gap;
    line[i] = Token{Token::Kind::Number, std::to_string(*value), gap};
    line.erase(line.begin() + static_cast<std::ptrdiff_t>(i) + 1,
               line.begin() + static_cast<std::ptrdiff_t>(i + used));
  }
}

/// Without the signs of JSON and YAML: `"fade": [50, 0, 8, 140],`, `- delay: 500`.
Tokens without_signs(Tokens line) {
  std::erase_if(line, [](const Token& token) {
    return token.is("[") || token.is("]") || token.is("{") || token.is("}");
  });
  if (line.size() > 1 && line[0].is("-"))
    line.erase(line.begin());
  for (auto& token : line)
    if (token.is_text() && (spec::find_macro_command(token.text) != nullptr ||
                            token.text == "macro" || token.text == "id"))
      token.kind = Token::Kind::Word;
  read_hexadecimal(line);
  if (line.size() > 3 && line[1].is(":") && line[2].is(".") && line[3].is("macro"))
    line.erase(line.begin() + 2);
  if (line.size() > 3 && line[1].is(":") && equal_words(line[2].text, "macro"))
    line[2].text = ".macro";
  if (line.size() > 2 && line[1].is(":"))
    for (std::size_t i = 2; i < line.size(); ++i) // `loop_start: mov 8`
      if (is_move(line[i]))
        line.erase(line.begin() + static_cast<std::ptrdiff_t>(i));
  const bool has_id =
      std::any_of(line.begin(), line.end(), [](const Token& token) { return token.is("id"); });
  if (line.size() > 2 && line[0].is_text() && line[1].is(":") && has_id) // `"brass": {"id": 41}`
    line.insert(line.begin(), Token{Token::Kind::Word, ".macro"});
  if (line.size() > 2 && line[1].is("macro") && line[0].is_word()) // `start macro right with id 61`
    line.erase(line.begin());
  constexpr auto defines = std::to_array<std::string_view>(
      {"def", "sub", "proc", "function", "routine", "define", "func"});
  if (has_id && std::any_of(defines.begin(), defines.end(),
                            [&](std::string_view word) { return line[0].is(word); }))
    line[0].text = ".macro";
  if (line.size() > 2 && line[0].is_word() && line[1].is(":") && line[2].is(".macro")) { // a label
    std::swap(line[0], line[2]);
    std::swap(line[1], line[2]);
  }
  if (!line.empty() && line[0].is_word() && line[0].text.starts_with('.')) {
    const auto bare = repair::tokens_of(line[0].text.substr(1), repair::Language::Macro);
    const auto own = bare.empty() ? std::string() : repair::word_at(bare, 0);
    if (own == "const")
      line[0].text = ".const";
    else if (!bare.empty() && (bare[0].is("makro") || bare[0].is("Makro") || bare[0].is("Macro")))
      line[0].text = ".macro";
  }
  return line;
}

} // namespace

std::vector<Rephrased> rephrase(const Tokens& written, const Elsewhere& elsewhere) {
  const auto& constants = elsewhere.constants;
  auto line = joined(without_signs(written));
  if (line.empty() || !line[0].is_word())
    return {};
  if (line.size() > 1 && (line[0].is(".macro") || line[0].is("macro")))
    return rephrase_header(line);
  if (line[0].is(".const") || line[0].is("const")) {
    const std::size_t value = line.size() > 2 && (line[2].is("=") || line[2].is(":")) ? 3 : 2;
    if (line.size() <= value || !line[1].is_word())
      return {};
    auto rest = after(line, value);
    if (rest.size() == 1 && rest[0].is_text())
      rest = repair::tokens_of(rest[0].text, repair::Language::Macro);
    if (const auto part = repair::quantity_of(rest, constants);
        part && part->measure == Measure::Percent) { // of a speed or a brightness
      constexpr std::int64_t hundred = 100 * whole;  // per cent
      return {{fmt::format(".const {} = {}", line[1].text,
                           (part->thousandths * UINT8_MAX + hundred / 2) / hundred),
               false}};
    }
    const auto known = repair::compute(rest, constants);
    return known ? std::vector<Rephrased>{{fmt::format(".const {} = {}", line[1].text, *known)}}
                 : std::vector<Rephrased>();
  }
  const auto* info = command_of(line);
  return info == nullptr ? std::vector<Rephrased>() : rephrase_command(*info, line, elsewhere);
}

} // namespace orb::assembler
