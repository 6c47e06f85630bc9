#include "assembler/text/foreign.h"

#include "base/text/text.h"
#include "repair/arrange.h"
#include "repair/idioms.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace orb::assembler {
namespace {

using repair::Token;
using repair::Tokens;

/// `mov`, `please`: words before a command that add nothing.
bool is_move(const Token& token) {
  return holds(
      "mov ld ldi lda li move set do turn let make please now then the my put use run start "
      "db cmd out call change",
      token.text);
}

/// `let speed = 0` and `set rotation rate to 255`: the command that sets it, its values behind it.
Tokens without_let(const Tokens& line) {
  constexpr std::size_t most = 3; // words of a mnemonic
  if (line.empty() || !holds("let set put make define imposta setze", line[0].text))
    return line;
  std::string word;
  const std::size_t first = line.size() > 2 && line[1].is("the") ? 2 : 1;
  for (auto i = first; i < line.size() && i <= most && line[i].is_word(); ++i) {
    word += (i > first ? "_" : "") + lower(line[i].text);
    const bool sets = i + 2 < line.size() && (line[i + 1].is("=") || line[i + 1].is("to"));
    if (holds("light lights led leds color colour", word))
      word = "rgb";
    if (holds("back_light tail_light rear_light back_rgb", word))
      word = "back_led";
    const bool known = spec::find_macro_command(word) != nullptr;
    if (!sets || (!known && spec::find_macro_command("set_" + word) == nullptr))
      continue;
    auto all = repair::slice(line, i + 1);
    all[0] = Token{Token::Kind::Word, known ? word : "set_" + word};
    return all;
  }
  return line;
}

/// `rgb.Set(255, 0, 0)` and `await sleep(step)`: calls of other languages.
void plain_call(Tokens& line) {
  if (line[0].is("async") || line[0].is("await"))
    line.erase(line.begin());
  if (line.size() > 3 && line[1].is(".") && line[3].is("(") &&
      spec::find_macro_command(line[0].text) != nullptr)
    line.erase(line.begin() + 1, line.begin() + 3);
  if ((line.size() > 2 && line[0].is("sleep") && line[1].is("(") && line[2].is_word()) ||
      (line.size() == 2 && line[0].text == "SLEEP")) // of BASIC: a wait
    line[0].text = spec::info(spec::MacroCommand::Delay).mnemonic;
}

/// What parts of mnemonics are called elsewhere.
constexpr auto parts_called = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"set", "imposta imposte fija fijar pon poner regler setze mets ajusta defina definir define"},
    {"start", "inicio início inizio début debut anfang begin"},
    {"loop", "repeat bucle boucle ciclo laço schleife"},
    {"rate", "velocita velocità velocidad velocidade vitesse tempo"},
});

/// Whether a word can stand for a part of a mnemonic: `warte` for `wait`, `stopp` for `stopped`.
bool stands_for(const std::string& word, const std::string& part) {
  constexpr std::size_t stem = 3; // letters
  constexpr std::size_t long_ = 6;
  constexpr std::size_t little = 2;
  const auto translated = repair::word_at(repair::tokens_of(word, repair::Language::Macro), 0);
  return word == part || translated == part || repair::is_called(part, word) ||
         (part == "stopped" && repair::is_called("resting", word)) ||
         (word.size() >= stem && part.size() >= stem &&
          (word.starts_with(part) || part.starts_with(word))) ||
         (word.size() > long_ && word.substr(0, long_) == part.substr(0, long_)) ||
         std::any_of(
             parts_called.begin(), parts_called.end(),
             [&](const auto& one) { return part == one.first && holds(one.second, word); }) ||
         (part == "rotation" && word.starts_with("rot")) ||
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
    if (!std::equal(said.begin(), said.end(), parts.begin(), parts.end(), stands_for) &&
        !std::equal(said.rbegin(), said.rend(), parts.begin(), parts.end(), stands_for))
      continue;
    if (found != nullptr)
      return nullptr;
    found = &info;
  }
  return found;
}

/// `loop-start` and `loop start` are one word.
Tokens joined(const Tokens& line) {
  for (const std::size_t size : {3U, 2U}) {
    if (line.size() < size || !line[0].is_word() || !line[size - 1].is_word() ||
        (size == 3 && (!line[1].is("-") || line[2].gap)))
      continue;
    const auto word = line[0].text + "_" + line[size - 1].text;
    const auto* info = spec::find_macro_command(word);
    if (info == nullptr && repair::parts_of(word).size() > 2 &&
        spec::find_macro_command(line[0].text) == nullptr)
      info = command_in_parts(word); // `pauseUntil stopped`
    if (info == nullptr)
      continue;
    auto all = repair::slice(line, size - 1);
    all[0].text = info->mnemonic;
    return all;
  }
  if (line.size() > 2 && line[1].is_number() && line[0].is_word() && // `set_sd 2 70`
      spec::find_macro_command(line[0].text + line[1].text) != nullptr) {
    auto all = repair::slice(line, 1);
    all[0] = Token{Token::Kind::Word, line[0].text + line[1].text};
    return all;
  }
  return line;
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
  constexpr std::string_view set = "set"; // `setrgb_sd2`
  if (info == nullptr && token.text.starts_with(set))
    info = spec::find_macro_command(std::string_view(token.text).substr(set.size()));
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

} // namespace

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

namespace {

/// `&H00FFFF`: three numbers in one.
void read_colour(Tokens& line) {
  constexpr std::size_t digits = 6;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const std::string_view text = line[i + 1].text;
    if (!line[i].is("&") || text.size() != digits + 1 || to_lower(text[0]) != 'h')
      continue;
    Tokens values;
    for (std::size_t at = 1; at < text.size(); at += 2)
      if (const auto value = parse_number<std::uint32_t>(text.substr(at, 2), 16))
        values.push_back(Token{Token::Kind::Number, std::to_string(*value), true});
    if (values.size() * 2 != digits)
      continue;
    const auto at = line.begin() + static_cast<std::ptrdiff_t>(i);
    line.insert(line.erase(at, at + 2), values.begin(), values.end());
  }
}

/// `80h`, `0C8h`, `0xFEh` and `$FF` in decimal.
void read_hexadecimal(Tokens& line) {
  read_colour(line);
  for (std::size_t i = 0; i < line.size(); ++i) {
    std::string digits = line[i].text;
    std::size_t used = 1;
    if ((line[i].is("$") || line[i].is("#")) && i + 1 < line.size() && !line[i + 1].gap) {
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
  if (line.empty())
    return line;
  plain_call(line);
  line = without_let(line);
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
  if (has_id && holds("def sub proc procedure function routine define func to", line[0].text))
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
    else if (has_id || own == "makro" || own == "macro")
      line[0].text = ".macro";
  }
  return line;
}

} // namespace

Tokens own_signs(const Tokens& line) {
  return joined(without_signs(line));
}

bool is_jump(const Token& token) {
  return holds("jmp goto jump call gosub run do go to bra br jsr", token.text);
}

} // namespace orb::assembler
