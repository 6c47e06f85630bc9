#include "repair/gist.h"

#include "base/text/text.h"
#include "repair/arrange.h"
#include "repair/colours.h"
#include "repair/fill.h"
#include "repair/units.h"
#include "repair/word_index.h"

#include <algorithm>
#include <array>
#include <optional>

namespace orb::repair {
namespace {

struct Topic {
  std::string_view name;
  std::string_view words;
};
constexpr auto topics = std::to_array<Topic>({
#define ORB_GIST(name, words) {name, words},
#include "repair/idioms.def"
});

/// The topics of a word; `filler` has none.
std::vector<std::string_view> topics_of(std::string_view word) {
  static const WordIndex index(topics, [](const Topic& topic) { return topic.words; });
  std::vector<std::string_view> found;
  for (const auto topic : index.lists_of(word))
    found.push_back(topics[topic].name);
  return found;
}

struct Value {
  std::string_view name; ///< heading, speed or time, if a word or a unit tells
  Tokens tokens;         ///< including its unit
};

/// Classifies the words of a line.
class Gist {
public:
  explicit Gist(const Surroundings& around) : around_(around) {}

  /// Returns false if a word remains unused.
  bool read(const Tokens& line) {
    if (is_own(line[0]) && assigns(line, 1))
      return false;
    std::size_t at = 0;
    while (at < line.size()) {
      const auto from = at;
      if (begins_value(line, at) && !names_value(line, at))
        take_value(line, at);
      else if (!take_word(line, at))
        return false;
      if (at == from)
        return false;
    }
    return names_.empty() || (names_.size() == 1 && names_[0] == "heading");
  }

  std::vector<std::string> statements() const {
    std::vector<std::string> all;
    const auto keep = [&](std::optional<std::string> one) {
      if (one)
        all.push_back(*std::move(one));
    };
    if (!subs_.empty())
      keep(call());
    else if (about("read") && about("datum") && values_.size() == 1)
      keep("read " + join(values_[0].tokens));
    else if (about("light") || colour_)
      keep(light());
    else if (about("stop"))
      keep(stop());
    else if (about("drive"))
      keep(drive());
    else if (about("wait") && values_.size() == 1 && values_[0].name != "heading")
      keep(fill("delay {wait:q}", holding('q', values_[0].tokens), around_));
    return all;
  }

private:
  bool is_own(const Token& token) const {
    const auto& word = token.text;
    const bool letter =
        around_.language == Language::Basic && word.size() == 1 && word[0] >= 'A' && word[0] <= 'Z';
    return token.is_word() && (letter || std::find(around_.names.begin(), around_.names.end(),
                                                   word) != around_.names.end());
  }

  bool about(std::string_view topic) const {
    return std::find(about_.begin(), about_.end(), topic) != about_.end();
  }

  static Holes holding(char letter, const Tokens& tokens) {
    Holes holes;
    holes[letter] = tokens;
    return holes;
  }

  bool begins_operand(const Tokens& line, std::size_t at) const {
    return at < line.size() &&
           (line[at].is_number() || is_own(line[at]) ||
            (line[at].is("(") && at + 1 < line.size() && begins_operand(line, at + 1)));
  }

  bool begins_value(const Tokens& line, std::size_t at) const {
    const bool sign = line[at].is("-") && at + 1 < line.size() && line[at + 1].is_number();
    return sign || line[at].is_number() || is_own(line[at]);
  }

  /// True if `direction` before a value names the value, even if the program has such a variable.
  bool names_value(const Tokens& line, std::size_t at) const {
    return is_own(line[at]) && line[at].text.size() > 1 && at + 1 < line.size() &&
           !about_.empty() && (is_own(line[at + 1]) || line[at + 1].is_number()) &&
           (is_called("heading", line[at].text) || line[at].is("heading") || line[at].is("speed") ||
            is_called("speed", line[at].text));
  }

  /// Takes a value: `side * 2`, `90 deg`, `seen[i + 1]`.
  void take_value(const Tokens& line, std::size_t& at) {
    const auto from = at;
    at += line[at].is("-") ? 2 : 1;
    bool called = is_own(line[from]) && at < line.size() && line[at].is("(");
    if (called && !about_.empty()) { // a function gives the value
      for (int depth = 0; at < line.size(); ++at) {
        depth += line[at].is("(") ? 1 : line[at].is(")") ? -1 : 0;
        if (depth == 0)
          break;
      }
      at = std::min(at + 1, line.size());
      called = false;
    }
    for (int depth = 0; at < line.size() && !called; ++at) {
      const bool opens = line[at].is("[") && is_own(line[at - 1]);
      const bool operates =
          line[at].kind == Token::Kind::Sign &&
          std::string_view("+-*/%").find(line[at].text) != std::string_view::npos &&
          begins_operand(line, at + 1) && (!line[at].gap || line[at + 1].gap);
      if (depth == 0 && !opens && !operates)
        break;
      depth += opens ? 1 : line[at].is("]") ? -1 : 0;
      if (operates)
        ++at;
    }
    Value value{names_.empty() ? "" : names_.front(),
                Tokens(line.begin() + static_cast<std::ptrdiff_t>(from),
                       line.begin() + static_cast<std::ptrdiff_t>(at))};
    if (!names_.empty())
      names_.erase(names_.begin());
    if (value.tokens.size() == 1 && is_own(line[from]) && values_.empty() && subs_.empty() &&
        (called || at == line.size() || begins_value(line, at) || line[at].is_word()) &&
        about_.empty() && !assigns(line, at))
      subs_ = line[from].text;
    else {
      take_unit(line, at, value);
      values_.push_back(std::move(value));
    }
  }

  static bool assigns(const Tokens& line, std::size_t at) {
    return at < line.size() && line[at].is("=");
  }

  static void take_unit(const Tokens& line, std::size_t& at, Value& value) {
    if (at >= line.size())
      return;
    if (line[at].is_word() && milliseconds_of(line[at].text) > 0) {
      value.name = "time";
      value.tokens.push_back(line[at++]);
    } else if (is_called("degrees", line[at].text) && !line[at].is("turn")) {
      value.name = "heading";
      ++at;
    }
  }

  bool take_word(const Tokens& line, std::size_t& at) {
    const auto& token = line[at];
    if (token.kind == Token::Kind::Sign) {
      ++at;
      return std::string_view("(),;=:.{}[]").find(token.text) != std::string_view::npos;
    }
    if (find_colour(token) && !colour_) {
      colour_ = token;
      ++at;
      return true;
    }
    if (!token.is_word())
      return false;
    ++at;
    if (milliseconds_of(token.text) > 0 && !values_.empty() && values_.back().name.empty()) {
      values_.back().name = "time"; // the unit follows a parenthesis
      values_.back().tokens.push_back(token);
      return true;
    }
    const auto words = parts_of(token.text);
    return std::all_of(words.begin(), words.end(),
                       [&](const std::string& word) { return take(word); });
  }

  bool take(const std::string& word) {
    for (const auto* const heading : {"0", "90", "180", "270"})
      if (is_called(heading, word) && (heading_.empty() || heading_ == heading)) {
        heading_ = heading;
        const auto about = topics_of(word);
        if (std::find(about.begin(), about.end(), "rear") != about.end())
          about_.push_back("rear");
        return true;
      }
    const auto found = topics_of(word);
    if (!found.empty()) {
      for (const auto topic : found)
        if (topic != "filler")
          about_.push_back(topic);
      return true;
    }
    for (const auto* const name : {"heading", "speed", "time"})
      if (word == name || is_called(name, word)) {
        names_.push_back(name);
        about_.push_back(std::string_view(name) == "time" ? "wait" : "drive");
        return true;
      }
    return false;
  }

  std::string list(const std::string& a, const std::string& b, const std::string& c) const {
    const auto* const comma = around_.language == Language::Basic ? "," : ", ";
    return a + comma + b + comma + c;
  }

  std::optional<std::string> call() const {
    std::string texts;
    for (const auto& value : values_) {
      const auto text = value.name == "time" ? fill("{ms:q}", holding('q', value.tokens), around_)
                                             : join(value.tokens);
      if (!text)
        return std::nullopt;
      texts += (texts.empty() ? "" : ", ") + *text;
    }
    if (around_.language != Language::Structured || colour_ || !heading_.empty())
      return std::nullopt;
    return texts.empty() ? subs_ : subs_ + "(" + texts + ")";
  }

  std::optional<std::string> light() const {
    if (about("rear"))
      return values_.size() == 1 && !colour_ ? std::optional("backLED " + join(values_[0].tokens))
                                             : std::nullopt;
    if (about("stop") || about("wait") || about("drive") || !heading_.empty())
      return std::nullopt;
    if (colour_ && values_.empty()) {
      const auto colour =
          write_colour(around_.language == Language::Basic ? "rgb" : "colour", {*colour_});
      return colour ? std::optional("RGB " + *colour) : std::nullopt;
    }
    if (values_.size() != 3 || colour_)
      return std::nullopt;
    return "RGB " + list(join(values_[0].tokens), join(values_[1].tokens), join(values_[2].tokens));
  }

  /// The value of this name, or without a name the next in order.
  const Value* value(std::string_view name) const {
    const auto found = std::find_if(values_.begin(), values_.end(),
                                    [&](const Value& one) { return one.name == name; });
    return found == values_.end() ? nullptr : &*found;
  }

  std::optional<std::string> stop() const {
    if (values_.size() > 1 || (values_.size() == 1 && value("time") != nullptr))
      return std::nullopt;
    const bool to_line = values_.size() == 1 && about("drive"); // `vai para 20`
    if (to_line || (values_.empty() && around_.pace.empty()))
      return std::nullopt;
    return "goroll " +
           list(values_.empty() ? std::to_string(around_.heading) : join(values_[0].tokens), "0",
                "0");
  }

  std::optional<std::string> drive() const {
    std::vector<std::string> plain;
    for (const auto& one : values_)
      if (one.name.empty())
        plain.push_back(join(one.tokens));
    const auto named = [&](std::string_view name) {
      const auto* const found = value(name);
      return found != nullptr ? join(found->tokens) : std::string();
    };
    auto next = plain.begin();
    const auto pick = [&](std::string text) {
      return !text.empty() || next == plain.end() ? text : *next++;
    };
    constexpr std::size_t all = 3;                                       // values of a roll
    const auto by_word = plain.size() == all ? std::string() : heading_; // `forward 90, 80, 1`
    const auto heading = pick(named("heading").empty() ? by_word : named("heading"));
    const auto speed = pick(named("speed"));
    const auto go = pick("");
    if (heading.empty() && speed == "0" && next == plain.end())
      return "goroll " + list(std::to_string(around_.heading), "0", "0");
    if (heading.empty() || speed.empty() || next != plain.end())
      return std::nullopt;
    const auto roll =
        "goroll " + list(heading, speed, go.empty() ? (speed == "0" ? "0" : "1") : go);
    const auto* const time = value("time");
    if (time == nullptr)
      return roll;
    const auto wait = fill("delay {sec:q}", holding('q', time->tokens), around_);
    return wait ? std::optional(roll + "\n" + *wait + "\ngoroll " + list(heading, "0", "0"))
                : std::nullopt;
  }

  const Surroundings& around_;
  std::vector<std::string_view> about_; ///< topics
  std::vector<Value> values_;
  std::vector<std::string_view> names_; ///< for the next values
  std::string heading_;                 ///< from a word: `left`
  std::string subs_;                    ///< of the program
  std::optional<Token> colour_;
};

} // namespace

std::vector<std::string> gist_of(const Tokens& line, const Surroundings& around) {
  Gist gist(around);
  const auto parts = line.empty() ? std::vector<std::string>() : parts_of(line[0].text);
  const bool to_place = parts.size() > 1 && (parts.back() == "to" || parts.back() == "xy");
  return line.size() > 1 && !to_place && gist.read(line) ? gist.statements()
                                                         : std::vector<std::string>();
}

} // namespace orb::repair
