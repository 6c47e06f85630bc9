#include "repair/fill.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace orb::repair {
namespace {

constexpr std::int64_t second_ms = 1000;
constexpr std::int64_t most_seconds = 20; // a wait for so few was meant in seconds
constexpr std::int64_t largest = 2147483647;

using Text = std::optional<std::string>;

struct Colour {
  std::string_view name; ///< as structured programs and tests write it
  std::uint32_t value;
  int code; ///< of LEDC; -1 without one
  std::string_view words;
};

constexpr auto colours = std::to_array<Colour>({
    {"red", 0xFF0000, 1, "red rot rojo roja rouge rosso rossa vermelho vermelha"},
    {"lime", 0x00FF00, 2, "green lime grün gruen verde vert verte"},
    {"blue", 0x0000FF, 3, "blue blau azul bleu blu azzurro"},
    {"orange", 0xFF8000, 4, "orange naranja arancione laranja"},
    {"purple", 0x8000FF, 5, "purple violet lila violett morado violeta viola roxo pourpre"},
    {"white", 0xFFFFFF, 6, "white weiß weiss blanco blanca blanc blanche bianco branco"},
    {"yellow", 0xFFFF00, 7, "yellow gelb amarillo jaune giallo amarelo"},
    {"black", 0x000000, 0, "black off dark schwarz aus negro noir nero preto apagado none"},
    {"aqua", 0x00FFFF, -1, "cyan aqua türkis turquoise"},
    {"fuchsia", 0xFF00FF, -1, "magenta fuchsia"},
    {"#FF69B4", 0xFF69B4, -1, "pink rosa rose"},
    {"gray", 0x808080, -1, "gray grey grau gris grigio cinza"},
    {"navy", 0x000080, -1, "navy"},
    {"teal", 0x008080, -1, "teal"},
    {"#8B4513", 0x8B4513, -1, "brown braun"},
});

bool holds(std::string_view words, std::string_view word) {
  for (std::size_t at = 0; at < words.size();) {
    const auto end = std::min(words.find(' ', at), words.size());
    if (equal_words(words.substr(at, end - at), word))
      return true;
    at = end + 1;
  }
  return false;
}

const Colour* named_colour(const Token& token) {
  if (!token.is_word() && !token.is_text())
    return nullptr;
  const auto found = std::find_if(colours.begin(), colours.end(),
                                  [&](const Colour& one) { return holds(one.words, token.text); });
  return found == colours.end() ? nullptr : &*found;
}

/// A number in thousandths, with a point or without.
std::optional<std::int64_t> thousandths(const Token& token) {
  if (!token.is_number() || token.text.size() > 12 || token.text.starts_with("0x"))
    return std::nullopt;
  std::int64_t value = 0;
  int places = -1;
  for (const char c : token.text) {
    if (c == '.') {
      places = 0;
      continue;
    }
    if (!is_digit(c) || places == 3)
      return std::nullopt;
    value = value * 10 + (c - '0');
    places += places >= 0 ? 1 : 0;
  }
  for (int i = std::max(places, 0); i < 3; ++i)
    value *= 10;
  return value;
}

std::optional<std::int64_t> whole(const Tokens& tokens) {
  if (tokens.size() != 1)
    return std::nullopt;
  const auto value = thousandths(tokens[0]);
  return value && *value % second_ms == 0 ? std::optional(*value / second_ms) : std::nullopt;
}

/// A value as a factor: in parentheses where an operator shows.
std::string as_factor(const Tokens& tokens) {
  const auto text = join(tokens);
  int depth = 0;
  bool bare = true;
  for (const auto& token : tokens) {
    depth += token.is("(") ? 1 : token.is(")") ? -1 : 0;
    bare = bare && (depth > 0 || token.is(")") || token.kind != Token::Kind::Sign);
  }
  return bare ? text : "(" + text + ")";
}

Text plus(const Tokens& tokens, std::int64_t step) {
  if (tokens.empty())
    return std::nullopt;
  if (const auto value = whole(tokens)) {
    if (*value + step < 0)
      return fmt::format("0 - {}", -(*value + step));
    if (*value + step > largest)
      return std::nullopt;
    return std::to_string(*value + step);
  }
  // `n + 1` less one is `n`
  const auto size = tokens.size();
  if (size > 2 && tokens[size - 1].is("1") && tokens[size - 2].is(step < 0 ? "+" : "-"))
    return join(Tokens(tokens.begin(), tokens.end() - 2));
  return fmt::format("{} {} {}", join(tokens), step < 0 ? '-' : '+', std::abs(step));
}

struct Unit {
  std::string_view words;
  std::int64_t ms; ///< per one
};
constexpr auto units = std::to_array<Unit>(
    {{"ms msec millis millisecond milliseconds millisekunden milisegundos millisecondes msecs", 1},
     {"s sec secs second seconds sekunde sekunden sek segundo segundos seconde secondes secondi "
      "secondo seg",
      second_ms},
     {"min mins minute minutes minuten minuto minutos minuti", 60 * second_ms}});

enum class Assume : std::uint8_t { Milliseconds, Seconds, Either };

/// Milliseconds, and whether they were said in another unit.
struct Time {
  std::int64_t ms;
  bool seconds;
};

std::optional<Time> time_of(const Tokens& tokens, Assume assume) {
  if (tokens.empty() || !tokens[0].is_number())
    return std::nullopt;
  auto first = tokens[0];
  std::size_t used = 1;
  if (tokens.size() >= 3 && tokens[1].is(",") && tokens[2].is_number() && !tokens[2].gap) {
    first.text += "." + tokens[2].text; // a decimal comma
    used = 3;
  }
  const auto value = thousandths(first);
  if (!value)
    return std::nullopt;
  const bool fraction = *value % second_ms != 0;
  if (used < tokens.size()) {
    const auto unit = std::find_if(units.begin(), units.end(), [&](const Unit& one) {
      return tokens[used].is_word() && holds(one.words, tokens[used].text);
    });
    if (unit == units.end() || used + 1 != tokens.size() || (*value * unit->ms) % second_ms != 0)
      return std::nullopt;
    return Time{*value * unit->ms / second_ms, unit->ms > 1};
  }
  const bool seconds = assume == Assume::Seconds || fraction ||
                       (assume == Assume::Either && *value <= most_seconds * second_ms);
  return Time{seconds ? *value : *value / second_ms, seconds};
}

Text written_time(const Tokens& tokens, Assume assume, Language language) {
  if (tokens.size() == 1 && tokens[0].is_text())
    return written_time(tokens_of(tokens[0].text, language), assume, language);
  if (const auto time = time_of(tokens, assume)) {
    if (language == Language::Basic || !time->seconds)
      return std::to_string(time->ms);
    if (time->ms % second_ms == 0)
      return fmt::format("{}s", time->ms / second_ms);
    return fmt::format("{}ms", time->ms);
  }
  for (const auto& token : tokens)
    if (token.is_text() || token.is(",") ||
        (token.is_number() && token.text.find('.') != std::string::npos))
      return std::nullopt;
  return assume == Assume::Seconds ? fmt::format("{} * 1000", as_factor(tokens)) : join(tokens);
}

/// A time of a test file: always with its unit.
Text clock(const Tokens& tokens) {
  if (tokens.size() == 1 && tokens[0].is("end"))
    return "end";
  const auto time = time_of(tokens, Assume::Either);
  if (!time)
    return std::nullopt;
  return time->ms % second_ms == 0 ? fmt::format("{}s", time->ms / second_ms)
                                   : fmt::format("{}ms", time->ms);
}

Text length(const Tokens& tokens) {
  if (tokens.empty() || !tokens[0].is_number() || tokens.size() > 2)
    return tokens.empty() ? Text("") : std::nullopt;
  if (tokens.size() == 1)
    return tokens[0].text + "cm";
  const auto& unit = tokens[1].text;
  if (holds("cm centimetres centimeters zentimeter centimetre centimeter", unit))
    return tokens[0].text + "cm";
  if (holds("m metre metres meter meters", unit))
    return tokens[0].text + "m";
  return std::nullopt;
}

/// The opposite of a condition of one comparison.
Text opposite(Tokens tokens, Language language) {
  if (language != Language::Basic)
    return fmt::format("not ({})", join(tokens));
  while (tokens.size() > 2 && tokens.front().is("(") && tokens.back().is(")"))
    tokens = Tokens(tokens.begin() + 1, tokens.end() - 1);
  std::size_t at = tokens.size();
  std::size_t relations = 0;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].is("and") || tokens[i].is("or"))
      return std::nullopt;
    for (const auto* sign : {"=", "!", "<", ">", "<=", ">=", "==", "!=", "<>"})
      if (tokens[i].is(sign)) {
        at = i;
        ++relations;
      }
  }
  if (relations == 0)
    return tokens.size() == 1 ? Text(join(tokens) + " = 0") : std::nullopt;
  if (relations > 1)
    return std::nullopt;
  const auto left = join(Tokens(tokens.begin(), tokens.begin() + static_cast<std::ptrdiff_t>(at)));
  const Tokens right(tokens.begin() + static_cast<std::ptrdiff_t>(at) + 1, tokens.end());
  const auto& sign = tokens[at].text;
  const auto with = [&](std::string_view other) {
    return fmt::format("{} {} {}", left, other, join(right));
  };
  if (sign == "=" || sign == "==")
    return with("!");
  if (sign == "!" || sign == "!=" || sign == "<>")
    return with("=");
  if (sign == "<=")
    return with(">");
  if (sign == ">=")
    return with("<");
  const auto value = whole(right);
  if (!value)
    return sign == "<" ? fmt::format("{0} > {1} or {0} = {1}", left, join(right))
                       : fmt::format("{0} < {1} or {0} = {1}", left, join(right));
  const auto limit = plus(right, sign == "<" ? -1 : 1);
  return limit ? Text(fmt::format("{} {} {}", left, sign == "<" ? '>' : '<', *limit))
               : std::nullopt;
}

/// Text with `{name}` in it, as items of `print`.
std::string parts_of(std::string_view text, std::string_view open, std::string_view close) {
  std::string items;
  while (!text.empty()) {
    const auto begin = text.find(open);
    const auto end = begin == std::string_view::npos ? begin : text.find(close, begin);
    const auto said = text.substr(0, end == std::string_view::npos ? end : begin);
    if (!said.empty())
      items += fmt::format("{}\"{}\"", items.empty() ? "" : " ", said);
    if (end == std::string_view::npos)
      break;
    items += fmt::format("{}{}", items.empty() ? "" : " ",
                         text.substr(begin + open.size(), end - begin - open.size()));
    text.remove_prefix(end + close.size());
  }
  return items.empty() ? "\"\"" : items;
}

/// `"%d left\n", n`: a format with its values.
Text formatted(const Tokens& tokens) {
  auto text = tokens[0].text;
  while (text.ends_with("\\n"))
    text.resize(text.size() - 2);
  std::vector<Tokens> values;
  for (std::size_t i = 1; i < tokens.size(); ++i)
    if (tokens[i].is(",") || tokens[i].is("%"))
      values.emplace_back();
    else if (!values.empty())
      values.back().push_back(tokens[i]);
  std::string items;
  std::size_t next = 0;
  std::string said;
  const auto flush = [&] {
    if (!said.empty())
      items += fmt::format("{}\"{}\"", items.empty() ? "" : " ", said);
    said.clear();
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto mark = std::string_view(text).substr(i);
    const auto width = mark.starts_with("%d") || mark.starts_with("%i") || mark.starts_with("{}") ||
                               mark.starts_with("%s") || mark.starts_with("%u")
                           ? 2U
                       : mark.starts_with("%ld") ? 3U
                                                 : 0U;
    if (width == 0) {
      said += text[i];
      continue;
    }
    if (next == values.size())
      return std::nullopt;
    flush();
    items += fmt::format("{}{}", items.empty() ? "" : " ", join(values[next++]));
    i += width - 1;
  }
  flush();
  return next == values.size() && !items.empty() ? Text(items) : std::nullopt;
}

/// A list for `print`: texts side by side, without `+`, `str()` and formats.
Text items(const Tokens& tokens) {
  if (tokens.empty())
    return std::nullopt;
  if (tokens[0].is_text() && tokens[0].text.find('%') != std::string::npos && tokens.size() > 1)
    if (auto text = formatted(tokens))
      return text;
  if (tokens.size() == 1 && tokens[0].is_text() && tokens[0].text.ends_with("\\n"))
    return formatted(tokens);
  std::string out;
  int depth = 0;
  bool apart = true;
  const auto beside_text = [&](std::size_t i) {
    return (i > 0 && tokens[i - 1].is_text()) ||
           (i + 1 < tokens.size() && tokens[i + 1].is_text()) ||
           (i + 1 < tokens.size() && (tokens[i + 1].is("str") || tokens[i + 1].is("String"))) ||
           (i > 0 && tokens[i - 1].is(")") && out.ends_with("\x01"));
  };
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const auto& token = tokens[i];
    const bool converts =
        token.is("str") || token.is("String") || token.is("STR") || token.is("string");
    if (converts && i + 1 < tokens.size() && tokens[i + 1].is("(")) {
      Tokens inner;
      int open = 0;
      for (++i; i < tokens.size(); ++i) {
        open += tokens[i].is("(") ? 1 : tokens[i].is(")") ? -1 : 0;
        if (open == 0)
          break;
        if (!(open == 1 && inner.empty() && tokens[i].is("(")))
          inner.push_back(tokens[i]);
      }
      out += (apart ? "" : " ") + join(inner) + "\x01";
      apart = false;
      continue;
    }
    const bool joins =
        token.is("+") || token.is("&") || token.is("<<") || token.is(".") || token.is("..");
    if (depth == 0 && (token.is(";") || (joins && beside_text(i)))) {
      if (token.is(";") && i + 1 == tokens.size())
        out += ";";
      apart = false;
      continue;
    }
    if ((token.is("f") || token.is("$")) && i + 1 < tokens.size() && tokens[i + 1].is_text() &&
        !tokens[i + 1].gap) {
      out += (apart ? "" : " ") + parts_of(tokens[++i].text, "{", "}");
      apart = false;
      continue;
    }
    if (token.is_text() && token.text.find("${") != std::string::npos) {
      out += (apart ? "" : " ") + parts_of(token.text, "${", "}");
      apart = false;
      continue;
    }
    depth += token.is("(") ? 1 : token.is(")") ? -1 : 0;
    const bool wants_gap = !apart && !token.is(",") &&
                           (token.gap || i == 0 || token.is_text() || tokens[i - 1].is_text() ||
                            out.ends_with("\x01") || tokens[i - 1].is("+"));
    out += (wants_gap ? " " : "") + (token.is_text() ? '"' + token.text + '"' : token.text);
    apart = false;
  }
  out.erase(std::remove(out.begin(), out.end(), '\x01'), out.end());
  while (!out.empty() && out.front() == ' ')
    out.erase(out.begin());
  return out.empty() ? std::nullopt : Text(out);
}

/// Words without their quotes, as a text.
Text quoted(const Tokens& tokens) {
  std::string text;
  constexpr std::string_view plain = ".!?:,";
  for (const auto& token : tokens) {
    if (!token.is_word() &&
        (text.empty() || !(token.is_number() || plain.find(token.text) != std::string_view::npos)))
      return std::nullopt;
    text += (token.gap && !text.empty() ? " " : "") + token.text;
  }
  return text.size() < 3 ? std::nullopt : Text(fmt::format("\"{}\"", text));
}

/// `a` to `b` by the robot's `rnd`, which gives 1 to its value.
Text dice(const Tokens& from, const Tokens& to, Language language) {
  const auto a = whole(from);
  const auto b = whole(to);
  if (!a || !b || *b <= *a)
    return std::nullopt;
  const auto call = language == Language::Basic ? fmt::format("rnd {}", *b - *a + 1)
                                                : fmt::format("rnd({})", *b - *a + 1);
  if (*a == 1)
    return call;
  // An operand of `rnd` goes to the end of the expression on the robot.
  if (language == Language::Basic)
    return *a > 1 ? fmt::format("{} + rnd {}", *a - 1, *b - *a + 1)
                  : fmt::format("rnd {} - 1", *b - *a + 1);
  return *a > 1 ? fmt::format("{} + {}", call, *a - 1) : fmt::format("{} - {}", call, 1 - *a);
}

Text colour(std::string_view function, const Tokens& tokens) {
  if (tokens.size() != 1)
    return std::nullopt;
  const auto value = find_colour(tokens[0]);
  const auto* const named = named_colour(tokens[0]);
  if (!value)
    return std::nullopt;
  const auto hex = fmt::format("#{:06X}", *value);
  if (function == "rgb")
    return fmt::format("{}, {}, {}", *value >> 16, *value >> 8 & 0xFF, *value & 0xFF);
  if (function == "code")
    return named != nullptr && named->code >= 0 ? Text(std::to_string(named->code)) : std::nullopt;
  if (named == nullptr)
    return hex;
  if (function == "testcolour")
    return std::string(named->name == "lime"    ? "green"
                       : named->name == "black" ? "off"
                       : named->name == "purple" || named->name == "orange" ||
                               named->name == "red" || named->name == "blue" ||
                               named->name == "white" || named->name == "yellow"
                           ? named->name
                           : std::string_view(hex));
  return named->name == "purple" || named->name == "orange" ? hex : std::string(named->name);
}

/// Three values, or a colour.
Text channels(const Tokens& tokens) {
  if (tokens.size() == 1)
    return colour("rgb", tokens);
  Tokens plain;
  for (const auto& token : tokens)
    if (!token.is("(") && !token.is(")") && !token.is("[") && !token.is("]"))
      plain.push_back(token);
  return join(plain);
}

/// `int n, int m`: the names alone.
Text parameters(const Tokens& tokens) {
  std::string out;
  for (std::size_t i = 0; i < tokens.size(); ++i)
    if (tokens[i].is(","))
      out += ", ";
    else if (tokens[i].is_word() && (i + 1 == tokens.size() || tokens[i + 1].is(",") ||
                                     tokens[i + 1].is("as") || tokens[i + 1].is(":")))
      out += tokens[i].text;
    else if ((tokens[i].is("as") || tokens[i].is(":")) && i + 1 < tokens.size())
      ++i;
  return out.empty() ? std::nullopt : Text(out);
}

Text call(std::string_view function, const Tokens& a, const Tokens& b, const Holes& holes,
          const Surroundings& around) {
  const auto language = around.language;
  if (function == "sec")
    return written_time(a, Assume::Seconds, language);
  if (function == "wait")
    return written_time(a, Assume::Either, language);
  if (function == "ms")
    return written_time(a, Assume::Milliseconds, language);
  if (function == "clock")
    return clock(a);
  if (function == "length")
    return length(a);
  if (function == "less")
    return plus(a, -1);
  if (function == "more")
    return plus(a, +1);
  if (function == "toward")
    return plus(a, !b.empty() && b[0].is("-") ? +1 : -1);
  if (function == "factor")
    return a.empty() ? Text("") : Text(as_factor(a));
  if (function == "unit")
    return as_factor(a);
  if (function == "not")
    return opposite(a, language);
  if (function == "items")
    return items(a);
  if (function == "quoted")
    return quoted(a);
  if (function == "known")
    return a.size() == 1 && std::find(around.names.begin(), around.names.end(), a[0].text) !=
                                around.names.end()
               ? Text(a[0].text)
               : std::nullopt;
  if (function == "dice")
    return dice(a, b, language);
  if (function == "zero")
    return a.empty() ? Text("0") : Text(join(a));
  if (function == "channels")
    return channels(a);
  if (function == "parameters")
    return parameters(a);
  if (function == "hexword" || function == "hexrgb") {
    if (a.empty())
      return function == "hexword" ? Text("") : std::nullopt;
    const auto digits = a[0].text;
    const auto value = parse_number<std::uint32_t>(digits, 16);
    if (!value || *value > static_cast<std::uint32_t>(largest))
      return std::nullopt;
    if (function == "hexword")
      return std::to_string(*value);
    if (digits.size() != 6)
      return std::nullopt;
    return language == Language::Structured
               ? Text("#" + digits)
               : Text(fmt::format("{},{},{}", *value >> 16, *value >> 8 & 0xFF, *value & 0xFF));
  }
  if (function == "bare") {
    Tokens inner = a;
    if (inner.size() == 1 && inner[0].is_text())
      return inner[0].text;
    if (inner.size() > 2 && inner.front().is("(") && inner.back().is(")"))
      inner = Tokens(inner.begin() + 1, inner.end() - 1);
    return join(inner);
  }
  if (function == "lower") {
    auto text = join(a);
    std::transform(text.begin(), text.end(), text.begin(), to_lower);
    return text;
  }
  if (function == "leftward") {
    const auto value = whole(a);
    return value && *value > 0 && *value < 360 ? Text(std::to_string(360 - *value)) : std::nullopt;
  }
  if (function == "hex") {
    const auto r = whole(a);
    const auto g = whole(b);
    const auto o = whole(holes['o']);
    return r && g && o && *r < 256 && *g < 256 && *o < 256
               ? Text(fmt::format("#{:02X}{:02X}{:02X}", *r, *g, *o))
               : std::nullopt;
  }
  return colour(function, a);
}

Text name_of(std::string_view name, const Holes& holes, const Surroundings& around) {
  const auto known = [](const std::string& text) {
    return text.empty() ? std::nullopt : Text(text);
  };
  if (name == "here")
    return known(around.line_number);
  if (name == "free")
    return known(around.free_letter);
  if (name == "loop")
    return known(around.loop);
  if (name == "closer")
    return known(around.closer);
  if (name == "fn")
    return known(holes.choice);
  if (name == "*")
    return join(holes.rest);
  if (name == "still")
    return holes.choice == "turn" || holes.choice == "rotate" || holes.choice == "spin" ? "0"
                                                                                        : "100";
  return join(holes[name[0]]);
}

} // namespace

std::optional<std::uint32_t> find_colour(const Token& token) {
  if (token.kind == Token::Kind::Colour || (token.is_text() && token.text.starts_with('#'))) {
    auto digits = token.text.substr(1);
    if (digits.size() == 3)
      digits = {digits[0], digits[0], digits[1], digits[1], digits[2], digits[2]};
    return digits.size() == 6 ? parse_number<std::uint32_t>(digits, 16) : std::nullopt;
  }
  const auto* const named = named_colour(token);
  return named != nullptr ? std::optional(named->value) : std::nullopt;
}

std::optional<std::string> fill(std::string_view form, const Holes& holes,
                                const Surroundings& around) {
  std::string out;
  for (std::size_t i = 0; i < form.size(); ++i) {
    if (form[i] != '{' && form[i] != '}') {
      out += form[i];
      continue;
    }
    if (i + 1 < form.size() && form[i + 1] == form[i]) {
      out += form[i++];
      continue;
    }
    const auto end = form.find('}', i);
    const auto inner = form.substr(i + 1, end - i - 1);
    const auto colon = inner.find(':');
    Text value;
    if (colon == std::string_view::npos) {
      value = name_of(inner, holes, around);
    } else {
      const auto arguments = inner.substr(colon + 1);
      static const Tokens none;
      value = call(inner.substr(0, colon), holes[arguments[0]],
                   arguments.size() > 2 ? holes[arguments[2]] : none, holes, around);
    }
    if (!value)
      return std::nullopt;
    out += *value;
    i = end;
  }
  while (!out.empty() && out.back() == ' ')
    out.pop_back();
  return out;
}

} // namespace orb::repair
