#include "repair/arrange.h"

#include "base/duration.h"
#include "base/text/text.h"
#include "repair/colours.h"
#include "repair/fill.h"
#include "repair/units.h"
#include "repair/word_index.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace orb::repair {
namespace {

constexpr auto one = Quantity::one;
constexpr std::int64_t most_thousandths = 1'000'000'000'000;

struct Calling {
  std::string_view name;
  std::string_view words;
};
constexpr auto callings = std::to_array<Calling>({
#define ORB_CALLED(name, words) {name, words},
#include "repair/idioms.def"
});

/// A value as it was written.
struct Given {
  std::string name; ///< of its operand, where that was said
  Quantity number;
  std::string word; ///< empty where it is a number
  std::string text; ///< as it was written, where it can stay so
};

/// What a unit counts, in thousandths.
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

/// A number in thousandths; nothing where it is finer or longer.
std::optional<std::int64_t> thousandths_of(std::string_view text) {
  if (const auto value = hexadecimal(text))
    return *value <= UINT32_MAX ? std::optional(*value * one) : std::nullopt;
  constexpr std::size_t longest = 9; // digits
  return text.substr(0, text.find('.')).size() <= longest ? thousandths_in(text) : std::nullopt;
}

/// Reads values from left to right; `*`, `/`, `+` and `-` compute.
class Values {
public:
  Values(const Tokens& tokens, const Quantities& known, bool divides = true)
      : tokens_(tokens), known_(known), divides_(divides) {}

  bool at_end() const { return at_ >= tokens_.size(); }
  const Token& here() const { return tokens_[at_]; }
  const Token* next() const { return at_ + 1 < tokens_.size() ? &tokens_[at_ + 1] : nullptr; }
  void skip() { ++at_; }
  std::size_t at() const { return at_; }

  bool begins_number() const {
    if (at_end())
      return false;
    const auto& token = here();
    return token.is_number() || token.is("(") || known_.contains(token.text) ||
           ((token.is("-") || token.is("+")) && next() != nullptr && next()->is_number());
  }

  std::optional<Quantity> sum() {
    auto left = product();
    while (left && !at_end() && (here().is("+") || here().is("-"))) {
      if (here().gap && (next() == nullptr || !next()->gap))
        break; // the sign of the next value
      const auto sign = here().is("-") ? -1 : 1;
      skip();
      const auto right = product();
      if (!right || !agree(*left, *right))
        return std::nullopt;
      left->thousandths += sign * right->thousandths;
      if (left->measure == Measure::Number)
        left->measure = right->measure;
    }
    return left;
  }

private:
  /// Whether two can be added.
  static bool agree(const Quantity& a, const Quantity& b) {
    return a.measure == b.measure || a.measure == Measure::Number || b.measure == Measure::Number;
  }

  std::optional<Quantity> product() {
    auto left = atom();
    while (left && !at_end() && (here().is("*") || (divides_ && here().is("/")))) {
      const bool times = here().is("*");
      skip();
      const auto right = atom();
      if (!right || (times ? left->measure != Measure::Number && right->measure != Measure::Number
                           : right->measure != Measure::Number || right->thousandths == 0))
        return std::nullopt;
      if (std::abs(left->thousandths) > most_thousandths ||
          std::abs(right->thousandths) > most_thousandths / one)
        return std::nullopt;
      left->thousandths = times ? left->thousandths * right->thousandths / one
                                : left->thousandths * one / right->thousandths;
      if (left->measure == Measure::Number)
        left->measure = right->measure;
    }
    return left;
  }

  std::optional<Quantity> atom() {
    if (at_end() || ++steps_ > most_steps)
      return std::nullopt;
    if (here().is("(")) {
      skip();
      const auto inner = sum();
      if (!inner || at_end() || !here().is(")"))
        return std::nullopt;
      skip();
      return inner;
    }
    if (const auto found = known_.find(here().text); found != known_.end() && here().is_word()) {
      skip();
      return found->second;
    }
    const auto sign = here().is("-") ? -1 : 1;
    if (here().is("-") || here().is("+"))
      skip();
    if (at_end() || !here().is_number())
      return std::nullopt;
    const auto value = thousandths_of(here().text);
    skip();
    if (!value)
      return std::nullopt;
    Quantity number{sign * *value, Measure::Number};
    if (at_end())
      return number;
    const bool is_name = next() != nullptr && (next()->is("=") || next()->is(":"));
    if (const auto unit = unit_of(here()); unit && !is_name) {
      number = {number.thousandths * (unit->thousandths / one), unit->measure};
      skip();
    }
    return number;
  }

  static constexpr int most_steps = 100;

  const Tokens& tokens_;
  const Quantities& known_;
  bool divides_; ///< or parts values
  std::size_t at_ = 0;
  int steps_ = 0;
};

/// A quantity as tests and macros write it.
std::string written(const Quantity& value) {
  switch (value.measure) {
  case Measure::Number: return thousandths_text(value.thousandths);
  case Measure::Percent: return thousandths_text(value.thousandths) + "%";
  case Measure::Angle: return thousandths_text(value.thousandths) + "deg";
  case Measure::Time:
    return value.thousandths % one == 0 ? time_text(value.thousandths / one)
                                        : thousandths_text(value.thousandths) + "ms";
  case Measure::Length:
  case Measure::Speed: break;
  }
  return {};
}

class Arranger {
public:
  Arranger(const std::vector<Operand>& operands, const Quantities& known)
      : operands_(operands), known_(known), bound_(operands.size()) {}

  std::optional<Arranged> run(const Tokens& tokens) {
    if (!read(tokens) || !bind())
      return std::nullopt;
    Arranged all;
    all.values.resize(operands_.size());
    all.named.resize(operands_.size());
    turn_round();
    for (std::size_t i = 0; i < operands_.size(); ++i) {
      const auto& operand = operands_[i];
      if (bound_[i] == nullptr && operand.optional)
        continue;
      if (bound_[i] == nullptr) {
        if (operand.usual.empty())
          return std::nullopt;
        all.values[i] = operand.usual;
        all.sure = false;
        continue;
      }
      const auto value = value_of(*bound_[i], operand);
      if (!value)
        return std::nullopt;
      const bool brims = operand.counts == Counts::Plain && operand.most == UINT8_MAX &&
                         bound_[i]->word.empty() && bound_[i]->number.measure == Measure::Number &&
                         bound_[i]->number.thousandths > operand.most * one;
      const bool wraps =
          operand.counts == Counts::Degrees && operand.least >= 0 && bound_[i]->word.empty() &&
          (bound_[i]->number.thousandths < 0 || bound_[i]->number.thousandths >= full_circle * one);
      const bool spoken = operand.counts == Counts::Degrees && !bound_[i]->word.empty();
      all.sure = all.sure && !spoken && !brims && !wraps && !exchanged_;
      all.named[i] = !bound_[i]->name.empty() && !is_colour(operand);
      if (too_long(*bound_[i], operand)) {
        if (extra_ != nullptr)
          return std::nullopt;
        extra_ = bound_[i];
      } else {
        all.values[i] = brims ? std::to_string(operand.most) : *value;
      }
    }
    if (extra_ != nullptr)
      all.wait = extra_->number.measure == Measure::Number ? extra_->text : written(extra_->number);
    return all;
  }

private:
  static bool is_colour(const Operand& operand) {
    return operand.name == "red" || operand.name == "green" || operand.name == "blue";
  }

  /// The operand that a word names; nothing where none is called so, or it has its value.
  const Operand* named(const Token& token) const {
    for (const auto& operand : operands_)
      if (equal_words(operand.name, token.text))
        return &operand;
    for (const auto& operand : operands_)
      if (is_called(operand.name, token.text) && !is_given(operand.name))
        return &operand;
    return nullptr;
  }

  bool is_given(std::string_view name) const {
    return std::any_of(given_.begin(), given_.end(),
                       [&](const Given& value) { return value.name == name; });
  }

  /// How a word that stands for a value is written; empty where it stands for none.
  std::string value_word(const Token& token) const {
    for (const auto& operand : operands_)
      for (const auto word : operand.words)
        if (equal_words(word, token.text) || is_called(word, token.text))
          return std::string(word);
    return {};
  }

  bool takes_colour() const {
    return std::any_of(operands_.begin(), operands_.end(), is_colour) && !is_given("red");
  }

  bool read(const Tokens& tokens) {
    auto bare = tokens;
    if (bare.size() > 2 && bare.front().is("(") && bare.back().is(")"))
      bare = Tokens(bare.begin() + 1, bare.end() - 1);
    for (auto& token : bare) // a quoted number is the number
      if (token.is_text() && !token.text.empty() && is_digit(token.text[0]))
        token.kind = Token::Kind::Word;
    Tokens all;
    for (auto& token : bare)
      if (token.is("=-")) {
        all.push_back(Token{Token::Kind::Sign, "=", token.gap});
        all.push_back(Token{Token::Kind::Sign, "-"});
      } else if (token.is_word() && is_digit(token.text[0]))
        for (auto& part : tokens_of(token.text, Language::Macro))
          all.push_back(part);
      else
        all.push_back(token);
    // Where several are named, `red 255` is one value, else `red` is a colour.
    several_channels_ = std::count_if(all.begin(), all.end(), [](const Token& token) {
                          return token.is("red") || token.is("green") || token.is("blue");
                        }) > 1;
    drop_false_percents(all);
    Values values(all, known_, operands_.size() == 1);
    std::string name;
    while (!values.at_end()) {
      const auto& token = values.here();
      if (token.is(",") || token.is(";") || token.is("=") || token.is(":") || token.is("/") ||
          token.is("|")) {
        values.skip();
        continue;
      }
      if (!read_value(values, name))
        return false;
    }
    return name.empty();
  }

  /// `0% 255% 120%` are no parts of a hundred.
  static void drop_false_percents(Tokens& all) {
    constexpr int most = 100;
    bool any = false;
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      any = any || (all[i + 1].is("%") && all[i].is_number() &&
                    parse_number<int>(all[i].text).value_or(0) > most);
    if (any)
      std::erase_if(all, [](const Token& token) { return token.is("%"); });
  }

  bool read_value(Values& values, std::string& name) {
    const auto& token = values.here();
    const auto* next = values.next();
    const bool assigned = next != nullptr && (next->is("=") || next->is(":"));
    if (values.begins_number()) {
      const auto from = values.at();
      const auto first = token;
      const auto number = values.sum();
      if (!number)
        return false;
      Given value{name, *number, {}, {}};
      if (values.at() == from + 1)
        value.text = first.text; // a number, or a name for it
      given_.push_back(std::move(value));
      name.clear();
      return true;
    }
    const auto colour = find_colour(token);
    if (colour && takes_colour() && !assigned && (name.empty() || name == "red") &&
        !(several_channels_ && named(token) != nullptr)) {
      for (const auto& [channel, shift] : {std::pair{"red", 16}, {"green", 8}, {"blue", 0}}) {
        const auto value = static_cast<std::int64_t>(*colour >> shift & 0xFF);
        given_.push_back({channel, {value * one, Measure::Number}, {}, std::to_string(value)});
      }
      name.clear();
      values.skip();
      return true;
    }
    if (!token.is_word() || !name.empty())
      return word_value(values, name);
    const bool number_follows = next != nullptr && (next->is_number() || next->is("-"));
    if (assigned || number_follows)
      if (const auto* operand = named(token)) {
        name = operand->name;
        values.skip();
        return true;
      }
    return word_value(values, name);
  }

  bool word_value(Values& values, std::string& name) {
    const auto& token = values.here();
    if (!token.is_word())
      return false;
    auto word = value_word(token);
    const bool takes_names =
        std::any_of(operands_.begin(), operands_.end(),
                    [](const Operand& operand) { return operand.counts == Counts::Name; });
    if (word.empty() && name.empty() && is_called("", token.text)) {
      values.skip(); // a word that says nothing: `for`, `at`
      return true;
    }
    if (const auto count = count_of(token); word.empty() && count > 0 && operands_.size() == 1) {
      given_.push_back({name, {count * one, Measure::Number}, {}, std::to_string(count)});
      name.clear();
      values.skip();
      return true;
    }
    if (word.empty() && takes_names)
      word = token.text;
    if (word.empty())
      return false;
    given_.push_back({name, {}, word, word});
    name.clear();
    values.skip();
    return true;
  }

  static bool suits(const Given& value, const Operand& operand) {
    if (!value.word.empty())
      return operand.counts == Counts::Name || std::find(operand.words.begin(), operand.words.end(),
                                                         value.word) != operand.words.end();
    switch (value.number.measure) {
    case Measure::Time: return operand.counts == Counts::Milliseconds;
    case Measure::Angle: return operand.counts == Counts::Degrees;
    case Measure::Percent: return operand.counts == Counts::Plain;
    case Measure::Number: return true;
    case Measure::Length:
    case Measure::Speed: break;
    }
    return false;
  }

  /// The first operand that has no value and suits; those that may lack come last.
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
      const auto at = static_cast<std::size_t>(
          std::find_if(operands_.begin(), operands_.end(),
                       [&](const Operand& operand) { return operand.name == value.name; }) -
          operands_.begin());
      if (at == operands_.size() || bound_[at] != nullptr || !suits(value, operands_[at]))
        return false;
      bound_[at] = &value;
    }
    place_large();
    const auto plain =
        std::count_if(operands_.begin(), operands_.end(),
                      [](const Operand& operand) { return operand.counts == Counts::Plain; });
    const auto tells = [plain](const Given& value) { // of which operand it is
      return value.number.measure != Measure::Number &&
             (value.number.measure != Measure::Percent || plain == 1);
    };
    for (const bool told : {true, false})
      for (const auto& value : given_) {
        if (!value.name.empty() || tells(value) != told || is_bound(value))
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

  bool is_bound(const Given& value) const {
    return std::find(bound_.begin(), bound_.end(), &value) != bound_.end();
  }

  /// A number that is too large where it stands goes where alone it fits.
  void place_large() {
    for (std::size_t i = 0; i < given_.size() && i < operands_.size(); ++i) {
      const auto number = given_[i].number.thousandths;
      if (!is_plain(&given_[i]) || number <= operands_[i].most * one || operands_[i].most == 0)
        continue;
      std::size_t found = operands_.size();
      std::size_t count = 0;
      for (std::size_t at = 0; at < operands_.size(); ++at)
        if (!operands_[at].optional && bound_[at] == nullptr &&
            number <= operands_[at].most * one) {
          found = at;
          ++count;
        }
      const bool rests = std::any_of(given_.begin(), given_.end(), [](const Given& value) {
        return is_plain(&value) && value.number.thousandths == 0;
      });
      if (count != 1 || (rests && operands_[i].name == "speed"))
        continue;
      bound_[found] = &given_[i];
      exchanged_ = true;
    }
  }

  /// A speed below 0 drives back.
  void turn_round() {
    for (std::size_t i = 0; i + 1 < operands_.size(); ++i) {
      if (operands_[i].name != "speed" || operands_[i + 1].name != "heading" ||
          bound_[i] == nullptr || bound_[i]->number.thousandths >= 0)
        continue;
      const auto speed = static_cast<std::size_t>(bound_[i] - given_.data());
      given_[speed].number.thousandths *= -1;
      given_[speed].text.clear();
      if (bound_[i + 1] == nullptr)
        continue;
      const auto heading = static_cast<std::size_t>(bound_[i + 1] - given_.data());
      given_[heading].number.thousandths += full_circle / 2 * one;
      given_[heading].text.clear();
    }
  }

  /// Whether a value stands where only a name or a word of it tells.
  static bool is_plain(const Given* value) {
    return value != nullptr && value->name.empty() && value->word.empty() &&
           value->number.measure == Measure::Number;
  }

  /// Whether a byte was meant as a part of 1.
  bool is_fraction(const Given& value, const Operand& operand) const {
    if (operand.most != UINT8_MAX || operand.counts == Counts::Milliseconds ||
        value.number.measure != Measure::Number)
      return false;
    const auto plain = [](const Given& each) {
      return each.word.empty() && each.number.measure == Measure::Number;
    };
    return std::any_of(given_.begin(), given_.end(),
                       [&](const Given& each) {
                         return plain(each) && each.number.thousandths % one != 0;
                       }) &&
           std::all_of(given_.begin(), given_.end(), [&](const Given& each) {
             return !plain(each) ||
                    (each.number.thousandths >= 0 && each.number.thousandths <= one);
           });
  }

  static bool too_long(const Given& value, const Operand& operand) {
    return operand.optional && operand.counts == Counts::Milliseconds && value.word.empty() &&
           value.number.thousandths > operand.most * one;
  }

  std::optional<std::string> value_of(const Given& value, const Operand& operand) const {
    if (!value.word.empty())
      return value.word;
    auto number = value.number;
    const bool whole = number.thousandths % one == 0;
    if (number.measure == Measure::Percent || is_fraction(value, operand)) {
      const auto full = number.measure == Measure::Percent ? 100 * one : one;
      return std::to_string((number.thousandths * operand.most + full / 2) / full);
    }
    if (operand.counts == Counts::Milliseconds && number.measure == Measure::Number && !whole)
      return written({number.thousandths * one, Measure::Time}); // so many seconds
    constexpr std::int64_t circle = 6284;                        // thousandths of a radian
    if (!whole && operand.counts == Counts::Degrees && number.measure == Measure::Number &&
        std::abs(number.thousandths) <= circle) {
      constexpr double degrees = 57.29577951308232; // of a radian
      return std::to_string(std::lround(static_cast<double>(number.thousandths) / one * degrees));
    }
    if (!whole)
      return std::nullopt;
    if (operand.counts == Counts::Degrees && operand.least >= 0) {
      const auto turns = number.thousandths / one % full_circle;
      const auto same = (turns + full_circle) % full_circle * one;
      if (same != number.thousandths)
        return written({same, number.measure});
    }
    return value.text.empty() ? written(number) : value.text;
  }

  const std::vector<Operand>& operands_;
  const Quantities& known_;
  std::vector<Given> given_;
  std::vector<const Given*> bound_;
  const Given* extra_ = nullptr;
  bool several_channels_ = false;
  bool exchanged_ = false;
};

const WordIndex& called_by() {
  static const WordIndex index(callings, [](const Calling& calling) { return calling.words; });
  return index;
}

} // namespace

bool is_called(std::string_view operand, std::string_view word) {
  const auto& lists = called_by().lists_of(word);
  return std::any_of(lists.begin(), lists.end(),
                     [&](std::size_t list) { return callings[list].name == operand; });
}

std::vector<std::string_view> meanings_of(std::string_view word) {
  std::vector<std::string_view> found;
  for (const auto list : called_by().lists_of(word))
    found.push_back(callings[list].name);
  return found;
}

std::vector<std::string_view> called_words() {
  std::vector<std::string_view> all;
  for (const auto& calling : callings)
    if (!calling.name.empty())
      for (const auto word : words_in(calling.words))
        all.push_back(word);
  return all;
}

bool mean_the_same(std::string_view a, std::string_view b) {
  if (is_called(a, b) || is_called(b, a))
    return true;
  const auto theirs = meanings_of(b);
  for (const auto mine : meanings_of(a))
    if (!mine.empty() && std::find(theirs.begin(), theirs.end(), mine) != theirs.end())
      return true;
  return false;
}

std::optional<std::string> test_colour(const Token& token) {
  return write_colour("testcolour", {token});
}

int count_of(const Token& token) {
  constexpr auto words = std::to_array<std::string_view>(
      {"one once", "two twice zwei dos deux due dois duas twee",
       "three thrice drei tres trois tre três drie", "four vier cuatro quatre quattro quatro",
       "five fünf fuenf cinco cinq cinque vijf", "six sechs seis sei zes",
       "seven sieben siete sept sette sete zeven", "eight acht ocho huit otto oito",
       "nine neun nueve neuf nove negen", "ten zehn diez dix dieci dez tien"});
  static const WordIndex index(words, [](std::string_view list) { return list; });
  if (token.is_number())
    return parse_number<int>(token.text).value_or(0);
  const auto& lists = index.lists_of(token.text);
  return lists.empty() ? 0 : static_cast<int>(lists.front()) + 1;
}

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
