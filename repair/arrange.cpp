#include "repair/arrange.h"

#include "base/duration.h"
#include "base/text/text.h"
#include "repair/fill.h"
#include "repair/idioms.h"
#include "repair/units.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace orb::repair {
namespace {

constexpr auto one = Quantity::one;

/// The value of one unit, in thousandths.
std::optional<Quantity> unit_of(const Token& token) {
  if (token.is("%") || holds("percent prozent porcento", token.text))
    return Quantity{one, Measure::Percent};
  if (!token.is_word())
    return std::nullopt;
  if (const auto ms = milliseconds_of(token.text); ms > 0)
    return Quantity{ms * one, Measure::Time};
  if (is_called("degrees", token.text))
    return Quantity{one, Measure::Angle};
  if (is_called("turns", token.text))
    return Quantity{full_circle * one, Measure::Angle};
  return std::nullopt;
}

/// Parses a number into thousandths; nothing if it is too precise or too long.
std::optional<std::int64_t> thousandths_of(std::string_view text) {
  if (const auto value = hexadecimal(text))
    return *value <= UINT32_MAX ? std::optional(*value * one) : std::nullopt;
  constexpr std::size_t longest = 9; // digits
  return text.substr(0, text.find('.')).size() <= longest ? thousandths_in(text) : std::nullopt;
}

/// Applies an operator to two values; nothing if their measures do not match.
std::optional<Quantity> computed(const Quantity& a, char sign, const std::optional<Quantity>& b) {
  constexpr std::int64_t most = 3'000'000'000; // thousandths whose product still fits
  const bool scales = sign == '*' || sign == '/';
  if (!b || std::abs(a.thousandths) > most || std::abs(b->thousandths) > most ||
      (sign == '/' && (b->thousandths == 0 || b->measure != Measure::Number)) ||
      (a.measure != Measure::Number && b->measure != Measure::Number &&
       (scales || a.measure != b->measure)))
    return std::nullopt;
  const auto x = a.thousandths;
  const auto y = b->thousandths;
  return Quantity{sign == '*'   ? x * y / one
                  : sign == '/' ? x * one / y
                  : sign == '+' ? x + y
                                : x - y,
                  a.measure == Measure::Number ? b->measure : a.measure};
}

/// Reads values from left to right and evaluates `*`, `/`, `+` and `-`.
class Values {
public:
  Values(const Tokens& tokens, const Quantities& known) : tokens_(tokens), known_(known) {}

  bool at_end() const { return at_ >= tokens_.size(); }
  const Token& here() const { return tokens_[at_]; }
  const Token* next() const { return at_ + 1 < tokens_.size() ? &tokens_[at_ + 1] : nullptr; }
  void skip() { ++at_; }
  std::size_t at() const { return at_; }

  bool begins_number() const {
    return here().is_number() || here().is("(") || known_.contains(here().text) ||
           ((here().is("-") || here().is("+")) && next() != nullptr && next()->is_number());
  }

  std::optional<Quantity> sum() {
    auto left = product();
    while (left && (sees("+") || sees("-"))) {
      if (here().gap && (next() == nullptr || !next()->gap))
        break; // the sign of the next value
      const auto sign = take();
      left = computed(*left, sign, product());
    }
    return left;
  }

private:
  bool sees(std::string_view sign) const { return !at_end() && here().is(sign); }
  char take() { return tokens_[at_++].text[0]; }

  std::optional<Quantity> product() {
    auto left = atom();
    while (left && (sees("*") || sees("/"))) {
      const auto sign = take();
      left = computed(*left, sign, atom());
    }
    return left;
  }

  std::optional<Quantity> atom() {
    if (sees("(")) {
      skip();
      const auto inner = sum();
      return sees(")") ? (skip(), inner) : std::nullopt;
    }
    if (!at_end() && here().is_word())
      if (const auto found = known_.find(here().text); found != known_.end()) {
        skip();
        return found->second;
      }
    const bool negative = sees("-");
    if (negative || sees("+"))
      skip();
    const auto value = !at_end() && here().is_number() ? thousandths_of(here().text) : std::nullopt;
    if (!value)
      return std::nullopt;
    skip();
    Quantity number{negative ? -*value : *value, Measure::Number};
    const bool is_name = !at_end() && next() != nullptr && (next()->is("=") || next()->is(":"));
    if (const auto unit = at_end() || is_name ? std::nullopt : unit_of(here())) {
      number = {number.thousandths * (unit->thousandths / one), unit->measure};
      skip();
    }
    return number;
  }

  const Tokens& tokens_;
  const Quantities& known_;
  std::size_t at_ = 0;
};

/// Prints a quantity in the notation of tests and macros.
std::string written(const Quantity& value) {
  const auto number = thousandths_text(value.thousandths);
  switch (value.measure) {
  case Measure::Percent: return number + "%";
  case Measure::Angle: return number + "deg";
  case Measure::Time:
    return value.thousandths % one == 0 ? time_text(value.thousandths / one) : number + "ms";
  case Measure::Number: return number;
  case Measure::Length:
  case Measure::Speed: break;
  }
  return {};
}

/// A value as written.
struct Given {
  std::string_view name; ///< of its operand, if given
  Quantity number;
  std::string word; ///< empty for a number
  std::string text; ///< as written, if it can stay so

  bool is_number() const { return word.empty() && number.measure == Measure::Number; }
};

/// A value in the notation of its operand.
struct Settled {
  std::string text;
  bool sure = true;
};

bool is_byte(const Operand& operand) {
  return operand.counts <= Counts::Speed && operand.most == UINT8_MAX;
}
bool is_direction(const Operand& operand) {
  return operand.counts == Counts::Degrees && operand.least >= 0;
}

class Arranger {
public:
  Arranger(const std::vector<Operand>& operands, const Quantities& known)
      : operands_(operands), known_(known), bound_(operands.size()) {}

  std::optional<Arranged> run(const Tokens& tokens) {
    if (!read(tokens) || !bind())
      return std::nullopt;
    turn_round();
    Arranged all{{}, std::vector<bool>(operands_.size()), {}, !exchanged_};
    for (std::size_t i = 0; i < operands_.size(); ++i) {
      const auto& operand = operands_[i];
      auto& text = all.values.emplace_back();
      if (bound_[i] == nullptr) {
        if (!operand.optional && operand.usual.empty())
          return std::nullopt;
        text = operand.optional ? std::string_view() : operand.usual;
        all.sure = all.sure && operand.optional;
        continue;
      }
      auto value = value_of(*bound_[i], operand);
      if (!value)
        return std::nullopt;
      all.sure = all.sure && value->sure;
      all.named[i] = !bound_[i]->name.empty() && operand.counts != Counts::Channel;
      if (!is_too_long(*bound_[i], operand))
        text = std::move(value->text);
      else if (extra_ != nullptr)
        return std::nullopt;
      else
        extra_ = bound_[i];
    }
    if (extra_ != nullptr)
      all.wait = extra_->number.measure == Measure::Number ? extra_->text : written(extra_->number);
    return all;
  }

private:
  bool is_given(std::string_view name) const {
    return std::any_of(given_.begin(), given_.end(),
                       [&](const Given& value) { return value.name == name; });
  }

  /// The operand that a word names; nothing if there is none, or if it already has a value.
  const Operand* named(const Token& token) const {
    for (const auto& operand : operands_)
      if (equal_words(operand.name, token.text))
        return &operand;
    for (const auto& operand : operands_)
      if (is_called(operand.name, token.text) && !is_given(operand.name))
        return &operand;
    return nullptr;
  }

  /// The spelling of a word that denotes a value; empty if it does not.
  std::string_view value_word(const Token& token) const {
    for (const auto& operand : operands_)
      for (const auto word : operand.words)
        if (equal_words(word, token.text) || is_called(word, token.text))
          return word;
    return {};
  }

  /// Normalizes values: unquotes numbers, splits `=-` into two signs, drops `%` after more than a
  /// hundred.
  Tokens plain(Tokens tokens) const {
    if (tokens.size() > 2 && tokens.front().is("(") && tokens.back().is(")"))
      tokens = slice(tokens, 1, tokens.size() - 1);
    constexpr int hundred = 100;
    Tokens all;
    bool parts = true; // parts of a hundred
    for (const auto& token : tokens) {
      if (token.is("=-"))
        append(all, {Token{Token::Kind::Sign, "=", token.gap}, Token{Token::Kind::Sign, "-"}});
      else if ((token.is_word() || token.is_text()) && !token.text.empty() &&
               is_digit(token.text[0]))
        append(all, tokens_of(token.text, Language::Macro));
      else
        all.push_back(token);
      if (token.is("/") && operands_.size() > 1)
        all.back().text = ","; // separates values
      parts = parts && !(token.is("%") && all.size() > 1 &&
                         parse_number<int>(all[all.size() - 2].text).value_or(0) > hundred);
    }
    if (!parts)
      std::erase_if(all, [](const Token& token) { return token.is("%"); });
    return all;
  }

  bool read(const Tokens& tokens) {
    const auto all = plain(tokens);
    // If several channels are named, `red 255` is one value; otherwise `red` is a colour.
    const bool one_channel = std::count_if(all.begin(), all.end(), [](const Token& token) {
                               return token.is("red") || token.is("green") || token.is("blue");
                             }) < 2;
    Values values(all, known_);
    std::string_view name;
    while (!values.at_end())
      if (holds(", ; = : / |", values.here().text))
        values.skip();
      else if (values.begins_number() ? !read_number(values, name)
                                      : !read_colour(values, name, one_channel) &&
                                            !read_name(values, name) && !read_word(values, name))
        return false;
    return name.empty();
  }

  /// Adds a value that ends before the current token.
  bool give(Given value, std::string_view& name) {
    value.name = std::exchange(name, {});
    given_.push_back(std::move(value));
    return true;
  }

  bool read_number(Values& values, std::string_view& name) {
    const auto from = values.at();
    const auto text = values.here().text;
    const auto number = values.sum();
    const bool whole = values.at() == from + 1; // a number, or a name for one
    return number && give({{}, *number, {}, whole ? text : std::string()}, name);
  }

  bool read_colour(Values& values, std::string_view& name, bool one_channel) {
    const auto& token = values.here();
    const auto first = std::find_if(operands_.begin(), operands_.end(), [](const Operand& operand) {
      return operand.counts == Counts::Channel;
    });
    const auto colour =
        first == operands_.end() || is_given(first->name) ? std::nullopt : find_colour(token);
    if (!colour || is_assigned(values) || !(name.empty() || name == first->name) ||
        (!one_channel && named(token) != nullptr))
      return false;
    values.skip();
    name = {};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = static_cast<std::int64_t>(*colour >> (16 - 8 * i) & 0xFF);
      name = (first + static_cast<std::ptrdiff_t>(i))->name;
      give({{}, {value * one, Measure::Number}, {}, std::to_string(value)}, name);
    }
    return true;
  }

  static bool is_assigned(const Values& values) {
    return values.next() != nullptr && (values.next()->is("=") || values.next()->is(":"));
  }

  bool read_name(Values& values, std::string_view& name) {
    const auto* next = values.next();
    if (!values.here().is_word() || !name.empty() || next == nullptr ||
        !(is_assigned(values) || next->is_number() || next->is("-")))
      return false;
    const auto* operand = named(values.here());
    if (operand == nullptr)
      return false;
    name = operand->name;
    values.skip();
    return true;
  }

  bool read_word(Values& values, std::string_view& name) {
    const auto token = values.here();
    if (!token.is_word())
      return false;
    values.skip();
    const auto word = value_word(token);
    if (word.empty() && name.empty() && is_called("", token.text))
      return true; // a filler word: `for`, `at`
    if (!word.empty())
      return give({{}, {}, std::string(word), {}}, name);
    if (const auto count = count_of(token); count > 0 && operands_.size() == 1)
      return give({{}, {count * one, Measure::Number}, {}, std::to_string(count)}, name);
    const bool takes_names =
        std::any_of(operands_.begin(), operands_.end(),
                    [](const Operand& operand) { return operand.counts == Counts::Name; });
    return takes_names && give({{}, {}, token.text, {}}, name);
  }

  static bool suits(const Given& value, const Operand& operand) {
    if (!value.word.empty())
      return operand.counts == Counts::Name || std::find(operand.words.begin(), operand.words.end(),
                                                         value.word) != operand.words.end();
    switch (value.number.measure) {
    case Measure::Time: return operand.counts == Counts::Milliseconds;
    case Measure::Angle: return operand.counts == Counts::Degrees;
    case Measure::Percent: return operand.counts <= Counts::Speed;
    case Measure::Number: return true;
    case Measure::Length:
    case Measure::Speed: break;
    }
    return false;
  }

  /// The first matching operand without a value; optional ones come last.
  std::size_t place_for(const Given& value) const {
    for (const bool optional : {false, true})
      for (std::size_t i = 0; i < operands_.size(); ++i)
        if (bound_[i] == nullptr && operands_[i].optional == optional && suits(value, operands_[i]))
          return i;
    return operands_.size();
  }

  bool bind() {
    for (const auto& value : given_) {
      if (value.name.empty())
        continue;
      std::size_t at = 0;
      while (operands_[at].name != value.name)
        ++at;
      if (bound_[at] != nullptr || !suits(value, operands_[at]))
        return false;
      bound_[at] = &value;
    }
    place_large();
    const auto plain =
        std::count_if(operands_.begin(), operands_.end(),
                      [](const Operand& operand) { return operand.counts <= Counts::Speed; });
    const auto tells = [plain](const Given& value) { // true if it identifies its operand
      return value.number.measure != Measure::Number &&
             (value.number.measure != Measure::Percent || plain == 1);
    };
    for (const bool told : {true, false})
      for (const auto& value : given_) {
        if (!value.name.empty() || tells(value) != told ||
            std::find(bound_.begin(), bound_.end(), &value) != bound_.end())
          continue;
        const auto at = place_for(value);
        if (at < operands_.size())
          bound_[at] = &value;
        else if (value.number.measure == Measure::Time && extra_ == nullptr)
          extra_ = &value;
        else
          return false;
      }
    return true;
  }

  /// Moves a number that is too large for its operand to the only one where it fits. Next to a 0 it
  /// is not a speed: the ball rests.
  void place_large() {
    const bool rests = std::any_of(given_.begin(), given_.end(), [](const Given& value) {
      return value.name.empty() && value.is_number() && value.number.thousandths == 0;
    });
    for (std::size_t i = 0; i < given_.size() && i < operands_.size(); ++i) {
      const auto fits = [&](std::size_t at) {
        return given_[i].number.thousandths <= operands_[at].most * one;
      };
      if (!given_[i].name.empty() || !given_[i].is_number() || fits(i) || operands_[i].most == 0 ||
          (rests && operands_[i].counts == Counts::Speed))
        continue;
      std::vector<std::size_t> places;
      for (std::size_t at = 0; at < operands_.size(); ++at)
        if (!operands_[at].optional && bound_[at] == nullptr && fits(at))
          places.push_back(at);
      if (places.size() != 1)
        continue;
      bound_[places[0]] = &given_[i];
      exchanged_ = true;
    }
  }

  /// A negative speed drives backward: turns the heading round.
  void turn_round() {
    const auto change = [&](const Given* value, std::int64_t factor, std::int64_t more) {
      auto& given = given_[static_cast<std::size_t>(value - given_.data())];
      given.number.thousandths = given.number.thousandths * factor + more;
      given.text.clear();
    };
    for (std::size_t i = 0; i + 1 < operands_.size(); ++i)
      if (operands_[i].counts == Counts::Speed && is_direction(operands_[i + 1]) &&
          bound_[i] != nullptr && bound_[i]->number.thousandths < 0) {
        change(bound_[i], -1, 0);
        if (bound_[i + 1] != nullptr)
          change(bound_[i + 1], 1, full_circle / 2 * one);
      }
  }

  /// True if a byte was meant as a fraction of 1.
  bool is_fraction(const Given& value, const Operand& operand) const {
    const auto all_of = [&](auto fits) {
      return std::all_of(given_.begin(), given_.end(), [&](const Given& each) {
        return !each.is_number() || fits(each.number.thousandths);
      });
    };
    return is_byte(operand) && value.is_number() &&
           !all_of([](std::int64_t number) { return number % one == 0; }) &&
           all_of([](std::int64_t number) { return number >= 0 && number <= one; });
  }

  static bool is_too_long(const Given& value, const Operand& operand) {
    return operand.optional && operand.counts == Counts::Milliseconds && value.word.empty() &&
           value.number.thousandths > operand.most * one;
  }

  std::optional<Settled> value_of(const Given& value, const Operand& operand) const {
    if (!value.word.empty())
      return Settled{value.word, !is_digit(value.word[0])}; // `right`, `forever`
    const auto number = value.number;
    if (number.measure == Measure::Percent || is_fraction(value, operand)) {
      const auto full = number.measure == Measure::Percent ? 100 * one : one;
      return Settled{std::to_string((number.thousandths * operand.most + full / 2) / full)};
    }
    const bool plain = number.measure == Measure::Number;
    constexpr std::int64_t circle = 6284; // thousandths of a radian
    if (number.thousandths % one != 0) {
      if (plain && operand.counts == Counts::Milliseconds) // meant in seconds
        return Settled{written({number.thousandths * one, Measure::Time})};
      if (!plain || operand.counts != Counts::Degrees || std::abs(number.thousandths) > circle)
        return std::nullopt;
      constexpr double degrees = 57.29577951308232; // of a radian
      return Settled{
          std::to_string(std::lround(static_cast<double>(number.thousandths) / one * degrees))};
    }
    if (is_direction(operand)) {
      const auto turns = number.thousandths / one % full_circle;
      const auto same = (turns + full_circle) % full_circle * one;
      if (same != number.thousandths)
        return Settled{written({same, number.measure}), false};
    }
    constexpr std::int64_t far = 100; // times: several numbers, typed without spaces
    if (is_byte(operand) && plain && number.thousandths > operand.most * far * one)
      return std::nullopt;
    if (is_byte(operand) && plain && number.thousandths > operand.most * one)
      return Settled{std::to_string(operand.most), false};
    return Settled{value.text.empty() ? written(number) : value.text};
  }

  const std::vector<Operand>& operands_;
  const Quantities& known_;
  std::vector<Given> given_;
  std::vector<const Given*> bound_;
  const Given* extra_ = nullptr;
  bool exchanged_ = false;
};

} // namespace

std::optional<Arranged> arrange(const Tokens& values, const std::vector<Operand>& operands,
                                const Quantities& known) {
  return Arranger(operands, known).run(values);
}

std::optional<Quantity> quantity_of(const Tokens& tokens, const Quantities& known) {
  Values values(tokens, known);
  const auto value = values.sum();
  return value && values.at_end() ? value : std::nullopt;
}

std::optional<std::string> compute(const Tokens& expression, const Quantities& known) {
  const auto value = quantity_of(expression, known);
  return value ? std::optional(written(*value)) : std::nullopt;
}

} // namespace orb::repair
