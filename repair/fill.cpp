#include "repair/fill.h"

#include "base/duration.h"
#include "base/text/text.h"
#include "repair/arrange.h"
#include "repair/colours.h"
#include "repair/print_items.h"
#include "repair/units.h"
#include "repair/word_index.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace orb::repair {
namespace {

constexpr std::int64_t second_ms = 1000;
constexpr std::int64_t most_seconds = 20; // a wait below this was meant in seconds
constexpr std::int64_t largest = 2147483647;

using Text = std::optional<std::string>;

/// Parses a number into thousandths, with or without a point.
std::optional<std::int64_t> thousandths(const Token& token) {
  constexpr std::size_t longest = 12;
  return token.is_number() && token.text.size() <= longest ? thousandths_in(token.text)
                                                           : std::nullopt;
}

std::optional<std::int64_t> whole(const Tokens& tokens) {
  if (tokens.size() != 1)
    return std::nullopt;
  const auto value = thousandths(tokens[0]);
  return value && *value % second_ms == 0 ? std::optional(*value / second_ms) : std::nullopt;
}

/// Prints a value as a factor: in parentheses if it contains an operator.
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

enum class Assume : std::uint8_t { Milliseconds, Seconds, Either };

/// A time in milliseconds; `has_unit` is false for a bare number.
struct Time {
  std::int64_t ms;
  bool has_unit;
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
  const bool fraction = *value % second_ms != 0 || (first.text.find('.') != std::string::npos &&
                                                    *value <= most_seconds * second_ms);
  if (used < tokens.size()) {
    const auto ms = tokens[used].is_word() ? milliseconds_of(tokens[used].text) : 0;
    const bool metres = tokens[used].is("m") && first.text.find('.') != std::string::npos;
    if (ms == 0 || metres || used + 1 != tokens.size() || (*value * ms) % second_ms != 0)
      return std::nullopt;
    return Time{*value * ms / second_ms, true};
  }
  const bool seconds = assume == Assume::Seconds || fraction ||
                       (assume == Assume::Either && *value <= most_seconds * second_ms);
  return Time{seconds ? *value : *value / second_ms, seconds};
}

Text written_time(const Tokens& tokens, Assume assume, Language language) {
  if (tokens.size() == 1 && tokens[0].is_text())
    return written_time(tokens_of(tokens[0].text, language), assume, language);
  constexpr std::int64_t longest_ms =
      1'000'000; // longer waits come from `delay 1000s` counted in ms
  if (auto time = time_of(tokens, assume)) {
    if (time->ms >= longest_ms && tokens.back().is("m")) // `500m`: the `s` is missing
      time->ms /= 60 * second_ms;
    else if (time->ms >= longest_ms && time->ms % second_ms == 0)
      time->ms /= second_ms;
    if (language == Language::Basic || !time->has_unit)
      return std::to_string(time->ms);
    return time_text(time->ms);
  }
  for (const auto& token : tokens)
    if (token.is_text() || token.is(",") ||
        (token.is_number() && token.text.find('.') != std::string::npos))
      return std::nullopt;
  if (const auto size = tokens.size(); assume == Assume::Seconds && size > 2 &&
                                       tokens[size - 2].is("/") && tokens[size - 1].is("1000"))
    return join(slice(tokens, 0, size - 2)); // already in milliseconds
  return assume == Assume::Seconds ? fmt::format("{} * 1000", as_factor(tokens)) : join(tokens);
}

/// A time in the notation of tests, always with its unit.
Text clock(const Tokens& tokens) {
  if (tokens.size() == 1 && tokens[0].is("end"))
    return "end";
  constexpr std::int64_t most_plain = 200; // limit for a number without a unit to be seconds
  const auto plain = whole(tokens);
  const auto time =
      time_of(tokens, plain && *plain <= most_plain ? Assume::Seconds : Assume::Either);
  if (!time)
    return std::nullopt;
  return time_text(time->ms);
}

Text length(const Tokens& tokens) {
  if (tokens.empty() || !tokens[0].is_number() || tokens.size() > 2)
    return tokens.empty() ? Text("") : std::nullopt;
  if (tokens.size() == 1)
    return tokens[0].text + "cm";
  static constexpr std::array written{unit::cm, unit::m};
  const auto* const unit = unit_called(tokens[1].text, Measure::Length);
  return unit != nullptr && find_unit(unit->word, written) != nullptr
             ? Text(fmt::format("{}{}", tokens[0].text, unit->word))
             : std::nullopt;
}

/// A length with a tolerance as a range in centimetres.
Text around_length(const Tokens& middle, const Tokens& tolerance) {
  const auto centimetres = [](const Tokens& tokens) -> std::optional<std::int64_t> {
    const auto* const unit =
        tokens.size() == 2 ? unit_called(tokens[1].text, Measure::Length) : &unit::cm;
    const bool is_length = !tokens.empty() && tokens.size() <= 2 && unit != nullptr;
    const auto length = is_length ? steps_of(tokens[0].text, unit->steps) : std::nullopt;
    return length ? std::optional(length->count / unit::cm.steps) : std::nullopt;
  };
  const auto cm = centimetres(middle);
  const auto off = centimetres(tolerance);
  return cm && off && *off <= *cm ? Text(fmt::format("{}cm..{}cm", *cm - *off, *cm + *off))
                                  : std::nullopt;
}

/// Turns a value into a condition: boolean sensors are compared with 1. A plain number is not a
/// condition.
Text as_comparison(const Tokens& tokens) {
  if (tokens.size() == 1 && tokens[0].is_number())
    return std::nullopt;
  const auto text = join(tokens);
  return text + (holds("dshake isconn cmdroll cmdrgb ctrl", text) ? " = 1" : " ! 0");
}

/// A random number from `a` to `b` by the robot's `rnd`, which gives 1 to its operand.
Text dice(const Tokens& from, const Tokens& to, Language language) {
  const auto a = whole(from);
  const auto b = whole(to);
  if (!a || !b || *b <= *a)
    return std::nullopt;
  const auto call = language == Language::Basic ? fmt::format("rnd {}", *b - *a + 1)
                                                : fmt::format("rnd({})", *b - *a + 1);
  if (*a == 1)
    return call;
  // On the robot, an operand of `rnd` extends to the end of the expression.
  if (language == Language::Basic)
    return *a > 1 ? fmt::format("{} + rnd {}", *a - 1, *b - *a + 1)
                  : fmt::format("(rnd {}) - {}", *b - *a + 1, 1 - *a);
  return *a > 1 ? fmt::format("{} + {}", call, *a - 1) : fmt::format("{} - {}", call, 1 - *a);
}

/// A decimal factor as a fraction.
Text fraction(const Tokens& tokens) {
  const auto value = tokens.size() == 1 ? thousandths(tokens[0]) : std::nullopt;
  if (!value || *value == 0 || *value % second_ms == 0)
    return std::nullopt;
  const auto divisor = std::gcd(*value, second_ms);
  return fmt::format("{} / {}", *value / divisor, second_ms / divisor);
}

/// Three values, or a colour as its three values.
Text channels(const Tokens& tokens) {
  if (tokens.size() == 1)
    return write_colour("rgb", tokens);
  const bool open = tokens.size() > 2 && (tokens[0].is("(") || tokens[0].is("["));
  return open && close_of(tokens, 0) + 1 == tokens.size()
             ? join(slice(tokens, 1, tokens.size() - 1))
             : join(tokens);
}

/// Strips types from parameters: `int n, int m`.
Text parameters(const Tokens& tokens) {
  std::string out;
  for (std::size_t i = 0; i < tokens.size(); ++i)
    if (tokens[i].is(","))
      out += ", ";
    else if (tokens[i].is_word() &&
             (i + 1 == tokens.size() || tokens[i + 1].is(",") || tokens[i + 1].is("as") ||
              tokens[i + 1].is(":") || tokens[i + 1].is("=")))
      out += tokens[i].text;
    else if ((tokens[i].is("as") || tokens[i].is(":") || tokens[i].is("=")) &&
             i + 1 < tokens.size())
      ++i;
  return out.empty() ? std::nullopt : Text(out);
}

Text hex_word(const Token& token) {
  const auto value = parse_number<std::uint32_t>(token.text, 16);
  return value && *value <= static_cast<std::uint32_t>(largest) ? Text(std::to_string(*value))
                                                                : std::nullopt;
}

/// A colour as one number: `FF8000`, `0xFF8000`, or the number that orbBasic reads for it.
Text hex_colour(const Token& token, Language language) {
  std::string_view digits = token.text;
  const bool prefixed = digits.size() > 1 && digits[0] == '0' && to_lower(digits[1]) == 'x';
  digits.remove_prefix(prefixed ? 2 : 0);
  const bool decimal = token.is_number() && !prefixed;
  const auto value = parse_number<std::uint32_t>(digits, decimal ? 10 : 16);
  if (!value || *value > 0xFFFFFF || (decimal ? *value <= 0xFFFF : digits.size() != 6))
    return std::nullopt;
  if (language == Language::Structured || language == Language::Test)
    return fmt::format("#{:06X}", *value);
  return fmt::format("{},{},{}", *value >> 16, *value >> 8 & 0xFF, *value & 0xFF);
}

/// Prints `0, 1, 2, 3, 4, 5` as `0 to 5`; nothing if the numbers are not consecutive.
Text counted(const Tokens& list) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (i % 2 == 1 ? !list[i].is(",")
                   : whole({list[i]}) != whole({list[0]}).value_or(-1) + static_cast<int>(i / 2))
      return std::nullopt;
  return list.size() > 2 ? Text(list.front().text + " to " + list.back().text) : std::nullopt;
}

/// Prints `c = 1 or c = 2` for a list and `c`.
Text any_of(const Tokens& list, const Tokens& value) {
  std::string all;
  for (const auto& token : list) {
    if (token.is(","))
      continue;
    if (!token.is_number() && !token.is_word())
      return std::nullopt;
    all += fmt::format("{}{} = {}", all.empty() ? "" : " or ", join(value), token.text);
  }
  return all;
}

/// Scratch parameters: `(r) (g) (b)` becomes `(r, g, b)`.
Text groups(const Tokens& tokens) {
  std::string all;
  for (std::size_t i = 0; i < tokens.size(); i += 3) {
    if (i + 2 >= tokens.size() || !tokens[i].is("(") || !tokens[i + 1].is_word() ||
        !tokens[i + 2].is(")"))
      return std::nullopt;
    all += (all.empty() ? "" : ", ") + tokens[i + 1].text;
  }
  return "(" + all + ")";
}

/// A range of lengths: small numbers are metres, large ones centimetres.
Text span(const Tokens& from, const Tokens& to) {
  constexpr std::int64_t most_metres = 20;
  const auto most = whole(to);
  const auto* const unit = most && *most <= most_metres ? "m" : "cm";
  return whole(from) && most ? Text(join(from) + unit + ".." + join(to) + unit) : std::nullopt;
}

/// The input of a template function.
struct Holding {
  const Tokens& a; ///< the hole
  const Tokens& b; ///< a second one, empty unless the template names it
  const Holes& holes;
  const Surroundings& around;

  Language language() const { return around.language; }
};

Text only(bool applies, std::string text) {
  return applies ? Text(std::move(text)) : std::nullopt;
}

Text bearing(const Tokens& a) {
  for (const auto* heading : {"0", "90", "180", "270"})
    if (a.size() == 1 && is_called(heading, a[0].text))
      return heading;
  return std::nullopt;
}

/// Joins `60 000`.
Text thousands(const Holding& held) {
  const auto& [a, b, holes, around] = held;
  const bool parted = a.size() == 1 && b.size() == 1 && a[0].text.size() <= 3 &&
                      b[0].text.size() == 3 && !a[0].is("0");
  return parted ? Text(a[0].text + b[0].text) : std::nullopt;
}

/// Strips quotes or parentheses around the whole.
Text bare(const Tokens& a) {
  if (a.size() == 1 && a[0].is_text())
    return a[0].text;
  if (a.size() > 2 && a.front().is("(") && a.back().is(")"))
    return join(Tokens(a.begin() + 1, a.end() - 1));
  return join(a);
}

/// The greatest of three brightnesses.
Text brightest(const Holding& held) {
  const auto three = {whole(held.a), whole(held.b), whole(held.holes['o'])};
  const auto most = std::max(three);
  return most.value_or(0) > 0 ? Text(std::to_string(*most)) : std::nullopt;
}

Text hex_of_three(const Holding& held) {
  const auto r = whole(held.a);
  const auto g = whole(held.b);
  const auto b = whole(held.holes['o']);
  return r && g && b && *r <= UINT8_MAX && *g <= UINT8_MAX && *b <= UINT8_MAX
             ? Text(fmt::format("#{:02X}{:02X}{:02X}", *r, *g, *b))
             : std::nullopt;
}

bool has(const std::vector<std::string_view>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Adjacent numbers with the missing commas.
Text values_apart(const Holding& held) {
  std::string out;
  for (const auto& token : held.a) {
    if (!token.is_number() && !token.is(",") && !token.is("-"))
      return std::nullopt;
    const bool lacks = !out.empty() && out.back() != ',' && out.back() != '-' && !token.is(",");
    out += (lacks ? "," : "") + token.text;
  }
  return out;
}

/// The name of a test function as a title: `test_stops_early` becomes "stops early".
std::string title(std::string name) {
  for (const auto* const begin : {"test_", "it_", "should_"})
    if (name.starts_with(begin))
      name.erase(0, std::string_view(begin).size());
  std::replace(name.begin(), name.end(), '_', ' ');
  return fmt::format("\"{}\"", name);
}

struct Function {
  std::string_view name;
  Text (*call)(const Holding&);
};
constexpr auto functions = std::to_array<Function>({
    // times, in milliseconds or with a unit; a zero time is another idiom
    {"sec",
     [](const Holding& held) {
       return whole(held.a) == 0 ? std::nullopt : written_time(held.a, Assume::Seconds, held.language());
     }},
    {"wait", [](const Holding& held) { return written_time(held.a, Assume::Either, held.language()); }},
    {"ms", [](const Holding& held) { return written_time(held.a, Assume::Milliseconds, held.language()); }},
    {"lasting", // not the `go` of a roll, 0 or 1
     [](const Holding& held) {
       const auto value = whole(held.a);
       return value == 0 || value == 1 ? std::nullopt
                                       : written_time(held.a, Assume::Seconds, held.language());
     }},
    {"brief", // neither a speed nor a heading
     [](const Holding& held) {
       const bool other = whole(held.a).value_or(0) >= most_seconds ||
                          (held.a.size() == 1 && is_called("heading", held.a[0].text));
       return other ? std::nullopt : written_time(held.a, Assume::Seconds, held.language());
     }},
    {"pace", // too large for seconds
     [](const Holding& held) { return only(whole(held.a).value_or(0) >= most_seconds, join(held.a)); }},
    {"commas", values_apart},
    {"later", // not a colour channel
     [](const Holding& held) {
       return whole(held.a).value_or(UINT8_MAX + 1) > UINT8_MAX
                  ? written_time(held.a, Assume::Milliseconds, held.language())
                  : std::nullopt;
     }},
    {"thousandth",
     [](const Holding& held) {
       const auto value = whole(held.a).value_or(0);
       return value < 1000 ? std::nullopt : Text(std::to_string(value / 1000)); // microseconds
     }},
    {"clock", [](const Holding& held) { return clock(held.a); }},

    // other quantities
    {"percent",
     [](const Holding& held) {
       const auto value = whole(held.a);
       return value && *value <= 100 ? Text(std::to_string((*value * UINT8_MAX + 50) / 100))
                                     : std::nullopt;
     }},
    {"speed", [](const Holding& held) { return only(whole(held.a).value_or(0) > 0, join(held.a)); }},
    {"length", [](const Holding& held) { return length(held.a); }},
    {"around", [](const Holding& held) { return around_length(held.a, held.b); }},
    {"bearing", // not a name of the program
     [](const Holding& held) {
       return held.a.size() == 1 && has(held.around.names, held.a[0].text) ? std::nullopt
                                                                          : bearing(held.a);
     }},
    {"compass", // a heading, not a number of turns
     [](const Holding& held) {
       const bool turns = whole(held.a).value_or(0) >= full_circle || has_token(held.a, "-");
       return only(!turns, join(held.a));
     }},
    {"leftward",
     [](const Holding& held) {
       const auto value = whole(held.a);
       return value && *value > 0 && *value < full_circle
                  ? Text(std::to_string(full_circle - *value))
                  : std::nullopt;
     }},
    {"ratio", [](const Holding& held) { return fraction(held.a); }},
    {"thousands", thousands},
    {"zero", [](const Holding& held) { return held.a.empty() ? Text("0") : Text(join(held.a)); }},

    // expressions and conditions
    {"less", [](const Holding& held) { return plus(held.a, -1); }},
    {"more", [](const Holding& held) { return plus(held.a, +1); }},
    {"toward",
     [](const Holding& held) { return plus(held.a, !held.b.empty() && held.b[0].is("-") ? +1 : -1); }},
    {"factor", [](const Holding& held) { return held.a.empty() ? Text("") : Text(as_factor(held.a)); }},
    {"unit", [](const Holding& held) { return Text(as_factor(held.a)); }},
    {"not", [](const Holding& held) { return opposite(held.a, held.language()); }},
    {"parts", // of a second
     [](const Holding& held) {
       const bool point = held.a.size() == 1 && held.a[0].text.find('.') != std::string::npos;
       return point ? written_time(held.a, Assume::Seconds, held.language()) : std::nullopt;
     }},
    {"groups", [](const Holding& held) { return groups(held.a); }},
    {"span", [](const Holding& held) { return span(held.a, held.b); }},
    {"anyof", [](const Holding& held) { return any_of(held.a, held.b); }},
    {"true", [](const Holding& held) { return as_comparison(held.a); }},
    {"dice", [](const Holding& held) { return dice(held.a, held.b, held.language()); }},
    {"below", // the second value is not among them
     [](const Holding& held) {
       return dice(held.a, tokens_of(plus(held.b, -1).value_or(""), held.language()), held.language());
     }},

    // words
    {"operand", // not a unit, and not a letter that looks like a digit
     [](const Holding& held) {
       const bool structured = held.language() == Language::Structured;
       const bool value = held.a.size() == 1 && (held.a[0].text.size() > 1
                              ? !structured || has(held.around.names, held.a[0].text)
                              : structured || to_lower(held.a[0].text[0]) != held.a[0].text[0]);
       return value && milliseconds_of(held.a[0].text) == 0 &&
                      (held.a[0].gap || !has({"O", "o", "l", "I"}, held.a[0].text)) ? Text(held.a[0].text)
                                                                   : std::nullopt;
     }},
    {"items", [](const Holding& held) { return print_items(held.a); }},
    {"count", [](const Holding& held) { return counted(held.a); }},
    {"quoted", // not a variable of the program
     [](const Holding& held) {
       return held.language() == Language::Basic && holds_name(held.a, held.around) ? std::nullopt
                                                                           : Text(quoted(held.a));
     }},
    {"said", // everything, without a time at the end
     [](const Holding& held) {
       const bool timed = std::any_of(held.a.begin(), held.a.end(), [](const Token& token) {
         return token.is("within") || token.is("at") || token.is("during") || token.is("times") ||
                token.is("after") || token.is("before");
       });
       return timed ? std::nullopt : Text(quoted(held.a));
     }},
    {"letter",
     [](const Holding& held) {
       return held.a.size() == 1 && !holds_name(held.a, held.around) && is_letter(held.a[0].text[0])
                  ? Text(std::string(1, to_upper(held.a[0].text[0])))
                  : std::nullopt;
     }},
    {"known",
     [](const Holding& held) {
       return held.a.size() == 1 && has(held.around.names, held.a[0].text) ? Text(held.a[0].text)
                                                                  : std::nullopt;
     }},
    {"output", // the meaning of `output` in Logo
     [](const Holding& held) {
       return held.around.in_function ? Text("return " + join(held.a)) : std::nullopt;
     }},
    {"alone", // a name that other lines read was not meant for the ball
     [](const Holding& held) { return only(!has(held.around.elsewhere, held.holes.choice), ""); }},
    {"apart", // a value that does not contain the other one
     [](const Holding& held) {
       const auto& other = held.b;
       const bool has_it = std::search(held.a.begin(), held.a.end(), other.begin(), other.end(),
                                       [](const Token& a, const Token& b) {
                                         return equal_words(a.text, b.text);
                                       }) != held.a.end();
       return only(!has_it, join(held.a));
     }},
    {"called", // in a program with `gosub`
     [](const Holding& held) { return only(has(held.around.elsewhere, "gosub"), ""); }},
    {"index", // which is not `Y` already
     [](const Holding& held) {
       return only(held.a.size() != 1 || !held.a[0].is("Y"), join(held.a));
     }},
    {"parameters", [](const Holding& held) { return Text(parameters(held.a)); }},
    {"title", [](const Holding& held) { return Text(title(join(held.a))); }},
    {"bare", [](const Holding& held) { return bare(held.a); }},

    // colours; the rest are those of write_colour()
    {"most", brightest},
    {"channels", [](const Holding& held) { return channels(held.a); }},
    {"hexword", [](const Holding& held) { return held.a.empty() ? Text("") : hex_word(held.a[0]); }},
    {"hexrgb",
     [](const Holding& held) { return held.a.empty() ? Text("") : hex_colour(held.a[0], held.language()); }},
    {"hex", hex_of_three},
});

Text call(std::string_view function, const Holding& held) {
  for (const auto& one : functions)
    if (one.name == function)
      return one.call(held);
  return write_colour(function, held.a);
}

Text name_of(std::string_view name, const Holes& holes, const Surroundings& around) {
  const auto known = [](const std::string& text) {
    return text.empty() ? std::nullopt : Text(text);
  };
  if (name == "here")
    return known(around.line_number);
  if (name == "below")
    return around.number_below.empty() ? "…" : around.number_below;
  if (name == "first")
    return known(around.first_number);
  if (name == "free")
    return known(around.free_letter);
  if (name == "nought" || name == "second") // an omitted value
    return name == "second" ? "1s" : "0";
  if (name == "loop")
    return known(around.loop);
  if (name == "returns") // in a program with `gosub`
    return has(around.elsewhere, "gosub") ? Text("return") : std::nullopt;
  if (name == "leaves") // at the end of a subroutine
    return around.ends_sub ? Text("return") : std::nullopt;
  if (name == "label")
    return known(around.label);
  if (name == "closer" && around.closer == "-")
    return Text(""); // the start of the program needs no end
  if (name == "closer")
    return known(around.closer);
  if (name == "fn")
    return known(holes.choice);
  if (name == "*")
    return join(holes.rest);
  if (name == "steering")
    return known(around.steering);
  if (name == "right" || name == "left") {
    const auto turn = name == "right" ? 90 : 270;
    return around.steering.empty()
               ? std::to_string((around.heading + turn) % full_circle)
               : fmt::format("({} + {}) % {}", around.steering, turn, full_circle);
  }
  if (name == "brake") { // stops a moving ball
    const auto* const comma = around.language == Language::Basic ? "," : ", ";
    return around.pace.empty() ? std::nullopt
                               : Text(fmt::format("goroll {}{}0{}0", around.heading, comma, comma));
  }
  if (name == "still" && !around.pace.empty())
    return around.pace;
  if (name == "still")
    return holes.choice == "turn" || holes.choice == "rotate" || holes.choice == "spin" ? "0"
                                                                                        : "100";
  return join(holes[name[0]]);
}

} // namespace

bool holds_name(const Tokens& tokens, const Surroundings& around) {
  return std::any_of(tokens.begin(), tokens.end(), [&](const Token& token) {
    return std::find(around.names.begin(), around.names.end(), token.text) != around.names.end();
  });
}

namespace {

/// The opposite of one comparison, or of a single value.
std::optional<std::string> opposite_comparison(const Tokens& tokens) {
  std::size_t at = tokens.size();
  std::size_t relations = 0;
  for (std::size_t i = 0; i < tokens.size(); ++i)
    if (tokens[i].is_relation()) {
      at = i;
      ++relations;
    }
  if (relations == 0)
    return tokens.size() == 1 ? std::optional(join(tokens) + " = 0") : std::nullopt;
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
  if (sign == "<=" || sign == "=<")
    return with(">");
  if (sign == ">=" || sign == "=>")
    return with("<");
  const auto value = whole(right);
  if (!value)
    return sign == "<" ? fmt::format("{0} > {1} or {0} = {1}", left, join(right))
                       : fmt::format("{0} < {1} or {0} = {1}", left, join(right));
  const auto limit = plus(right, sign == "<" ? -1 : 1);
  return limit ? Text(fmt::format("{} {} {}", left, sign == "<" ? '>' : '<', *limit))
               : std::nullopt;
}

/// Strips parentheses around the whole.
Tokens bared(Tokens tokens) {
  while (tokens.size() > 2 && tokens.front().is("(")) {
    int depth = 0;
    std::size_t close = 0;
    for (; close < tokens.size(); ++close) {
      depth += tokens[close].is("(") ? 1 : tokens[close].is(")") ? -1 : 0;
      if (depth == 0)
        break;
    }
    if (close + 1 != tokens.size())
      break;
    tokens = Tokens(tokens.begin() + 1, tokens.end() - 1);
  }
  return tokens;
}

} // namespace

std::optional<std::string> opposite(Tokens condition, Language language) {
  if (condition.size() <= 2 && condition.front().is_number())
    return std::nullopt; // a number or a time is not a condition
  if (language != Language::Basic)
    return condition.size() == 1 ? "not " + join(condition)
                                 : fmt::format("not ({})", join(condition));
  condition = bared(std::move(condition));
  if (condition.size() > 1 && (condition[0].is("not") || condition[0].is("!")))
    return join(bared(Tokens(condition.begin() + 1, condition.end())));
  const auto joins = [](const Token& token) {
    return token.is("and") || token.is("or") || token.is("&&") || token.is("||");
  };
  const auto joint = std::find_if(condition.begin(), condition.end(), joins);
  if (joint == condition.end())
    return opposite_comparison(condition);
  if (std::find_if(joint + 1, condition.end(), joins) != condition.end())
    return std::nullopt;
  const auto left = opposite_comparison(bared(Tokens(condition.begin(), joint)));
  const auto right = opposite_comparison(bared(Tokens(joint + 1, condition.end())));
  if (!left || !right || left->find(" or ") != std::string::npos ||
      right->find(" or ") != std::string::npos)
    return std::nullopt; // three comparisons
  const bool both = joint->is("and") || joint->is("&&");
  return fmt::format("{} {} {}", *left, both ? "or" : "and", *right);
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
      value = call(
          inner.substr(0, colon),
          {holes[arguments[0]], arguments.size() > 2 ? holes[arguments[2]] : none, holes, around});
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
