#include "assembler/text/rephrase.h"

#include "assembler/text/foreign.h"
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

/// `rgb 0 255120`: two bytes side by side, where only one way parts them.
void part_bytes(Tokens& values, std::size_t wanted) {
  const auto numbers = std::count_if(values.begin(), values.end(),
                                     [](const Token& token) { return token.is_number(); });
  if (static_cast<std::size_t>(numbers) + 1 != wanted)
    return;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto text = values[i].text;
    const bool led = text.size() > 1 && text[0] == '0' && is_digit(text[1]); // `0 08`
    if (!values[i].is_number() || (!led && parse_number<int>(text).value_or(0) <= UINT8_MAX))
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

/// The macro that can be meant where a command names none: those that nobody names yet but the
/// first, which is the one that the others are called from.
std::vector<Rephrased> with_macro(std::string_view mnemonic, const Elsewhere& elsewhere) {
  if (elsewhere.macros.empty())
    return {};
  std::vector<std::string> meant(elsewhere.macros.begin() + 1, elsewhere.macros.end());
  std::erase_if(meant, [&](const std::string& name) { return elsewhere.named.contains(name); });
  constexpr std::size_t shown = 2;
  if (meant.empty() || meant.size() > shown)
    return {};
  Rephrased all{fmt::format("{} {}", mnemonic, meant[0]), false};
  if (meant.size() == shown)
    all.other = fmt::format("{} {}", mnemonic, meant[1]);
  return {all};
}

/// `roll(0, 110, 255)`: a function of another language, perhaps with the heading first.
std::vector<Rephrased> rephrase_roll(const Tokens& line) {
  std::vector<std::string> values;
  for (const auto& token : repair::slice(line, 2)) {
    if (token.is(")"))
      break;
    if (token.is_number())
      values.push_back(token.text);
    else if (!token.is(","))
      return {};
  }
  const auto close = repair::close_of(line, 1);
  for (std::size_t i = close + 1; i < line.size(); ++i) // `roll(120, 0) delay=200`
    if (line[i].is_number())
      values.push_back(line[i].text);
  constexpr int brief = 20; // seconds, not milliseconds
  const auto time = values.size() == 3 ? parse_number<int>(values[2]).value_or(1) : 0;
  if (values.size() < 2 || values.size() > 3 || values[0] == values[1] ||
      (time > 0 && time < brief) || parse_number<int>(values[0]).value_or(UINT16_MAX) > UINT8_MAX ||
      parse_number<int>(values[1]).value_or(UINT16_MAX) > UINT8_MAX)
    return {};
  const auto delay = values.size() == 3 ? ", " + values[2] : std::string();
  return {{fmt::format("roll {}, {}{}", values[0], values[1], delay), false,
           fmt::format("roll {}, {}{}", values[1], values[0], delay)}};
}

std::vector<Rephrased> rephrase_command(const spec::MacroCommandInfo& info, const Tokens& line,
                                        const Elsewhere& elsewhere) {
  auto operands = std::vector<Operand>();
  for (const auto& row : info) {
    if (row.kind == MacroOperandKind::Text)
      return line.size() == 2 && line[1].is_text()
                 ? std::vector<Rephrased>{{fmt::format("{} \"{}\"", info.mnemonic, line[1].text)}}
                 : std::vector<Rephrased>();
    operands.push_back(operand_of(row));
  }
  if (info.command == spec::MacroCommand::Sleep)
    return {}; // elsewhere it is a wait
  if (info.command == spec::MacroCommand::Roll && line.size() > 1 && line[1].is("("))
    return rephrase_roll(line);
  for (auto& operand : operands)
    operand.usual = usual_of(info, operand, elsewhere);
  Tokens values = repair::slice(line, 1);
  if (spec::MacroBackground::Rotate == info.background)
    turn_left(values);
  if (info.command == spec::MacroCommand::RawMotors)
    say_modes(values);
  if (operands.size() == 1 && operands[0].counts == Counts::Milliseconds)
    join_decimals(values);
  if (operands.size() == 1 && operands[0].counts == Counts::Name && values.empty())
    return with_macro(info.mnemonic, elsewhere);
  if (operands.size() == 1 && operands[0].counts == Counts::Name && values.size() > 1)
    std::erase_if(values, [](const Token& token) { return token.is(":") || is_jump(token); });
  if (operands.size() == 1 && operands[0].counts == Counts::Name)
    for (auto& token : values)
      if (token.is_word() || token.is_text())
        token = Token{Token::Kind::Word, plain_name({token}), token.gap};
  const auto needed = std::count_if(operands.begin(), operands.end(),
                                    [](const Operand& operand) { return !operand.optional; });
  if (std::all_of(operands.begin(), operands.end(), [](const Operand& operand) {
        return operand.optional || (operand.counts == Counts::Plain && operand.most == UINT8_MAX);
      }))
    part_bytes(values, static_cast<std::size_t>(needed));
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
  bool in_seconds = false;
  const bool calls = line.size() > 1 && line[1].is("(");
  const auto written = [&](const std::vector<std::string>& operand_values) {
    std::string text(info.mnemonic);
    bool first = true;
    for (std::size_t i = 0; i < operands.size(); ++i) {
      if (operand_values[i].empty())
        continue;
      constexpr int most_seconds = 20; // of a time without a unit in a call, as Python writes them
      const auto& value = operand_values[i];
      const auto number = parse_number<int>(value);
      const bool seconds = calls && number && *number > 0 && *number <= most_seconds &&
                           operands[i].counts == Counts::Milliseconds;
      in_seconds = in_seconds || seconds;
      text += first || !commas ? " " : ", ";
      first = false;
      if (all_named || (operands[i].optional && arranged->named[i]))
        text += fmt::format("{}=", operands[i].name);
      text += value + (seconds ? "s" : "");
    }
    return text;
  };
  const auto text = written(arranged->values);
  // Who calls `roll(0, 100)` may think of the heading first, as other interfaces have it.
  const bool positional = std::none_of(arranged->named.begin(), arranged->named.end(),
                                       [](bool named) { return named; });
  if (info.command == spec::MacroCommand::Roll && calls && positional && arranged->wait.empty()) {
    auto exchanged = arranged->values;
    std::swap(exchanged[0], exchanged[1]);
    if (exchanged[0] != exchanged[1])
      return {{text, false, written(exchanged)}};
  }
  if (arranged->wait.empty())
    return {{text, arranged->sure && !in_seconds}};
  const auto waits = delays(arranged->wait);
  return waits.empty() ? std::vector<Rephrased>()
                       : std::vector<Rephrased>{{text + "\n" + waits, arranged->sure}};
}

constexpr std::size_t stem_letters = 4; // that tell a flag from the others

/// Whether words are of the same stems in any order: `controllo_motore` and `motor_control`.
bool have_same_stems(std::vector<std::string> said, std::vector<std::string> meant) {
  const auto stem = [](std::vector<std::string>& words) {
    for (auto& word : words)
      word.erase(std::min(word.size(), stem_letters));
    std::sort(words.begin(), words.end());
  };
  stem(said);
  stem(meant);
  return said.size() > 1 && said == meant;
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
    const auto written = without_accents(joined);
    std::erase_if(joined, [](char c) { return c == '_' || c == '-'; });
    if (holds(
            "none no null nothing keine keiner aucun aucune ninguno ninguna nessuno nessuna nenhum "
            "nenhuma geen",
            joined)) {
      flags.emplace_back("none");
      flag.clear();
      return true;
    }
    for (const auto& row : spec::macro_flags) {
      std::string bare(row.word);
      std::erase(bare, '_');
      const bool turned = have_same_stems(repair::parts_of(written), repair::parts_of(row.word));
      if (turned || equal_words(bare, joined) ||
          (joined.size() > stem_letters && bare.starts_with(lower(joined)))) { // `motor`
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
    const bool calls =
        name.empty() && token.is("call") && i + 1 < line.size() && line[i + 1].is_word();
    if (calls || token.is("called") || token.is("named") || (token.is("with") && !name.empty()))
      continue;
    if (token.is("and") && in == In::Name && !name.empty())
      continue;
    if (token.is("end") && i + 1 < line.size() && line[i + 1].is("signal")) {
      if (!end_flag())
        return {};
      flags.emplace_back("endsig");
      ++i;
      continue;
    }
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
    if (in == In::Id && id.empty() && holds("es ist is est è is vale", token.text))
      continue;
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
      const bool goes_on = !flag.empty() && spec::find_macro_flag(lower(flag.back().text) + "_" +
                                                                  lower(token.text)) != nullptr;
      if (token.gap && !flag.empty() && !goes_on && end_flag())
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
  constexpr std::string_view procedure = "PROC"; // of BBC Basic
  if (name.size() == 1 && name[0].text.starts_with(procedure) &&
      name[0].text.size() > procedure.size())
    name[0].text.erase(0, procedure.size());
  const auto plain = plain_name(name);
  if (plain.empty())
    return {};
  if (says_id && id.empty()) // the first that users' macros have
    id = std::to_string(spec::macro_id_user_first);
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
      if (const auto value = repair::quantity_of(repair::slice(tokens, 3), found.constants))
        found.constants.emplace(tokens[1].text, *value);
    if (tokens.size() > 1 && tokens[0].is(".macro") && tokens[1].is_word()) {
      found.macros.push_back(tokens[1].text);
      continue;
    }
    for (std::size_t i = 1; i < tokens.size(); ++i)
      if (tokens[i].is_word())
        found.named.insert(tokens[i].text);
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

std::vector<Rephrased> rephrase(const Tokens& written, const Elsewhere& elsewhere) {
  const auto& constants = elsewhere.constants;
  auto line = own_signs(written);
  if (line.size() == 1 && !repair::is_known_word(line[0].text, repair::Where::Line) &&
      std::find(elsewhere.macros.begin(), elsewhere.macros.end(), line[0].text) !=
          elsewhere.macros.end())
    return {{fmt::format("{} {}", spec::info(spec::MacroCommand::Gosub).mnemonic, line[0].text)}};
  if (line.size() > 3 && line[0].is_word() && line[1].is(".") && line[2].is_word())
    line.erase(line.begin(), line.begin() + 2); // `LED.Fade(…)`
  if (line.empty() || !line[0].is_word())
    return {};
  if (line.size() > 1 && (line[0].is(".macro") || line[0].is("macro")))
    return rephrase_header(line);
  if (line[0].is(".const") || line[0].is("const")) {
    if (line.size() > 4 && line[1].is_word() && line[2].is_word()) // `const int step = 500;`
      line.erase(line.begin() + 1);
    if (line.back().is(";"))
      line.pop_back();
    const std::size_t value = line.size() > 2 && (line[2].is("=") || line[2].is(":")) ? 3 : 2;
    if (line.size() <= value || !line[1].is_word())
      return {};
    auto rest = repair::slice(line, value);
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
  if (info == nullptr && line.size() == 2 &&
      std::find(elsewhere.macros.begin(), elsewhere.macros.end(), line[1].text) !=
          elsewhere.macros.end()) // `aufruf step`
    return {{fmt::format("{} {}", spec::info(spec::MacroCommand::Gosub).mnemonic, line[1].text),
             false}};
  return info == nullptr ? std::vector<Rephrased>() : rephrase_command(*info, line, elsewhere);
}

} // namespace orb::assembler
