#include "testing/text/pieces.h"

#include "base/duration.h"
#include "base/text/text.h"
#include "repair/arrange.h"
#include "repair/units.h"
#include "testing/text/vocabulary.h"
#include "vm/stimulus.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace orb::testing {
namespace {

using repair::Token;
using repair::Tokens;

constexpr Unit percent{"%", Measure::Percent, 1};

/// A test-file word as its table spells it; empty for other words.
std::string_view own_word(std::string_view word) {
  static const auto words = [] {
    auto all = operand_words();
    for (const auto* more :
         {"by", "points", "end", "on", "off", "then", "until", "between", "macro"})
      all.emplace_back(more);
    const auto add = [&](const auto& rows) {
      for (const auto& row : rows)
        all.push_back(row.word);
    };
    add(line_words);
    add(expectations);
    add(when_words);
    add(join_words);
    add(vm::stimulus_words);
    all.erase(std::find(all.begin(), all.end(), info(Word::Variable).word));
    return all;
  }();
  const auto found = std::find_if(words.begin(), words.end(),
                                  [&](std::string_view one) { return equal_words(one, word); });
  return found == words.end() ? std::string_view() : *found;
}

class PieceReader {
public:
  explicit PieceReader(const Tokens& line) : line_(line) {}

  Pieces read() {
    while (at_ < line_.size())
      if (!file() && !text() && !pattern() && !amount() && !word())
        sign();
    return std::move(all_);
  }

private:
  bool sees(std::size_t at, std::string_view what) const {
    return at < line_.size() && line_[at].is(what);
  }
  bool is_number(std::size_t at) const { return at < line_.size() && line_[at].is_number(); }
  bool is_word(std::size_t at) const { return at < line_.size() && line_[at].is_word(); }

  Piece& add(Piece::Kind kind, std::string text) {
    all_.push_back({kind, std::move(text)});
    return all_.back();
  }

  bool file() {
    const auto end = file_end(line_, at_);
    if (end == at_)
      return false;
    auto& piece = add(Piece::File, {});
    for (; at_ < end; ++at_)
      piece.text += line_[at_].text;
    return true;
  }

  bool text() {
    const bool part = line_[at_].is("~") && at_ + 1 < line_.size() && line_[at_ + 1].is_text();
    if (!part && !line_[at_].is_text())
      return false;
    at_ += part ? 1 : 0;
    const auto& said = line_[at_++];
    auto& piece = add(Piece::Text, (part ? "~\"" : "\"") + said.text + '"');
    piece.inner = said.text;
    if (!part)
      piece.colour = repair::test_colour(said).value_or("");
    return true;
  }

  /// From the first slash to the last one: the words between are a regular expression.
  bool pattern() {
    if (!line_[at_].is("/") || (at_ > 0 && !line_[at_ - 1].is_word() && !line_[at_ - 1].is("(")))
      return false;
    auto last = line_.size() - 1;
    while (last > at_ && !line_[last].is("/"))
      --last;
    if (last == at_)
      return false;
    auto tokens = repair::slice(line_, at_, last + 1);
    tokens[0].gap = false;
    add(Piece::Text, repair::join(tokens));
    at_ = last + 1;
    return true;
  }

  /// Reads the unit at `at` and moves `at` past it.
  const Unit* unit(std::size_t& at) const {
    if (at >= line_.size())
      return nullptr;
    const auto& token = line_[at];
    if (token.is("%"))
      return ++at, &percent;
    if (!token.is_word() || (token.gap && holds("in a", token.text)))
      return nullptr;
    const bool per_second = sees(at + 1, "/") && sees(at + 2, "s");
    if (repair::is_called("degrees", token.text) || token.is("deg"))
      return at += per_second ? 3 : 1, &unit::deg;
    if (per_second && (token.is("cm") || token.is("m")))
      return at += 3, token.is("m") ? &unit::m_s : &unit::cm_s;
    for (const auto measure : {Measure::Length, Measure::Time})
      if (const auto* const found = repair::unit_called(token.text, measure))
        return ++at, found;
    const auto* const hours = find_unit(token.text, time_units);
    at += hours != nullptr ? 1 : 0;
    return hours;
  }

  /// Reads the number at `at`, with its sign and unit, and moves `at` past it.
  std::optional<Amount> number(std::size_t& at) const {
    const bool signed_ =
        (sees(at, "-") || sees(at, "+")) && is_number(at + 1) && !line_[at + 1].gap;
    if (!signed_ && !is_number(at))
      return std::nullopt;
    Amount amount{(sees(at, "-") ? "-" : "") + line_[at + (signed_ ? 1 : 0)].text};
    if (amount.number.starts_with('.'))
      amount.number.insert(0, "0");
    at += signed_ ? 2 : 1;
    amount.unit = unit(at);
    return amount;
  }

  /// The index after the word or sign that joins the two numbers of a span; 0 if there is none.
  std::size_t behind_joint(std::size_t at) const {
    if (sees(at, "..") || sees(at, "...") || sees(at, "~"))
      return at + 1;
    if (sees(at, "-") && is_number(at + 1) && line_[at].gap == line_[at + 1].gap)
      return at + 1;
    if (at >= line_.size())
      return 0;
    const auto& token = line_[at];
    const bool to = token.is_word() &&
                    (holds("to a à", lower(token.text)) || repair::is_called("until", token.text));
    if (to)
      return sees(at + 1, "a") ? at + 2 : at + 1;
    const bool between = !all_.empty() && all_.back().means_any("between range");
    return between && (token.is(",") || has_meaning(token, "and")) ? at + 1 : 0;
  }

  static bool has_meaning(const Token& token, std::string_view meaning) {
    const auto all = token.is_word() ? meanings_of(token.text) : std::vector<std::string_view>();
    return std::find(all.begin(), all.end(), meaning) != all.end();
  }

  /// `x` or `y` before a coordinate; '\0' if there is none.
  char axis_at(std::size_t at) const {
    if (!is_word(at))
      return '\0';
    const auto name = lower(line_[at].text);
    return holds("x xcor xpos xcoord", name) ? 'x' : holds("y ycor ypos ycoord", name) ? 'y' : '\0';
  }

  bool amount() {
    auto at = at_;
    const char axis = axis_at(at);
    at += axis != '\0' ? 1 : 0;
    if (axis != '\0' && (sees(at, ",") || sees(at, ":")))
      ++at;
    std::string sign;
    for (; at < line_.size() &&
           (line_[at].is_relation() || line_[at].is("=-") || line_[at].is(">>") ||
            line_[at].is("<<") || line_[at].is("===")) &&
           !sees(at, "!");
         ++at) {
      const auto& said = line_[at].text;
      sign = said == "=<"                   ? "<="
             : said == "=>"                 ? ">="
             : said == "=-"                 ? "=-"
             : said[0] == '='               ? "="
             : said == ">>" || said == "<<" ? said.substr(1)
                                            : sign + said;
    }
    auto first = number(at);
    if (!first && at < line_.size() && repair::count_of(line_[at]) > 0 && at + 1 < line_.size() &&
        has_meaning(line_[at + 1], "times"))
      first = Amount{std::to_string(repair::count_of(line_[at++]))};
    if (!first)
      return false;
    if (sign == "=-") {
      sign = "=";
      first->number.insert(0, "-");
    }
    Piece piece{Piece::Number, {}};
    piece.axis = axis;
    piece.sign = sign;
    piece.most = *first;
    if (auto next = behind_joint(at); next > 0)
      if (const auto second = number(next)) {
        piece.kind = Piece::Span;
        piece.least = *std::exchange(first, second);
        piece.most = *second;
        if (piece.least.is_bare())
          piece.least.unit = piece.most.unit;
        if (piece.most.is_bare())
          piece.most.unit = piece.least.unit;
        const auto steps = [](const Amount& of) {
          return of.value() * (of.unit != nullptr ? static_cast<double>(of.unit->steps) : 1);
        };
        if (steps(piece.least) > steps(piece.most))
          std::swap(piece.least, piece.most);
        if (!all_.empty() && all_.back().means_any("between range"))
          all_.pop_back();
        at = next;
      }
    if (at < line_.size() && has_meaning(line_[at], "times") && axis == '\0' &&
        !(axis_at(at) != '\0' && at + 1 < line_.size() && !line_[at + 1].is_word())) {
      piece.is_count = true;
      ++at;
    } else if (!all_.empty() && all_.back().is(Piece::Word) && all_.back().means("times")) {
      piece.is_count = true; // `toHaveBeenCalledTimes(8)`
      all_.pop_back();
    } else if (piece.sign.empty() && piece.is(Piece::Number) && !all_.empty() &&
               (all_.back().means("<") || all_.back().means(">"))) { // `less than 300`
      piece.sign = all_.back().means("<") ? "<" : ">";
      all_.pop_back();
    } else if (at + 1 < line_.size() && sign.empty() && line_[at].is_relation() &&
               is_word(at + 1) && line_[at].text[0] != '=') { // `3m <= distance`
      piece.sign = line_[at].text[0] == '<' ? ">=" : "<=";
      ++at;
    }
    at_ = at;
    all_.push_back(std::move(piece));
    return true;
  }

  bool word() {
    const auto& token = line_[at_];
    const bool colour = token.kind == Token::Kind::Colour;
    if (!token.is_word() && !colour)
      return false;
    auto& piece = add(Piece::Word, token.text);
    piece.colour = repair::test_colour(token).value_or("");
    if (!colour)
      piece.meanings = meanings_of(token.text);
    const bool called = sees(at_ + 1, "(") || (at_ > 0 && line_[at_ - 1].is("."));
    if (piece.meanings.empty() && called && repair::parts_of(token.text).size() > 1)
      piece.meanings = {""}; // `toHaveBeenCalledWith`: framework jargon without a meaning here
    for (const auto meaning : piece.meanings) {
      constexpr std::string_view times = " times";
      if (!meaning.ends_with(times))
        continue;
      all_.pop_back();
      auto& count = add(Piece::Number, {});
      count.most.number = meaning.substr(0, meaning.size() - times.size());
      count.is_count = true;
      break;
    }
    ++at_;
    return true;
  }

  void sign() {
    const auto& token = line_[at_++];
    auto meanings = meanings_of(token.text);
    if (!meanings.empty() || !holds("( ) [ ] { } , : ; . ? = == === => - \" @", token.text))
      add(meanings.empty() ? Piece::Sign : Piece::Word, token.text).meanings = std::move(meanings);
    else if (token.is(",") || (token.is(":") && token.gap))
      add(Piece::Sign, ",");
    else if (token.is("-") && at_ > 1)
      add(Piece::Sign, token.text);
  }

  const Tokens& line_;
  std::size_t at_ = 0;
  Pieces all_;
};

} // namespace

double Amount::value() const {
  return parse_number<double>(number, std::chars_format::fixed).value_or(0);
}

bool Piece::means(std::string_view meaning) const {
  return std::find(meanings.begin(), meanings.end(), meaning) != meanings.end();
}

bool Piece::means_any(std::string_view all) const {
  return std::any_of(meanings.begin(), meanings.end(), [&](std::string_view meaning) {
    return !meaning.empty() && holds(all, meaning);
  });
}

bool is_of_tests(std::string_view word) {
  return !own_word(word).empty();
}

Pieces pieces_of(const Tokens& line) {
  return PieceReader(line).read();
}

std::vector<std::string_view> meanings_of(std::string_view word) {
  if (const auto own = own_word(word); !own.empty())
    return {own};
  auto all = repair::meanings_of(word);
  const auto parts = word.find('_') == std::string_view::npos ? repair::parts_of(word)
                                                              : std::vector<std::string>();
  if (parts.size() > 1) // `getHeading`, `toBeLessThan`
    for (const auto& part : parts) {
      const auto own = part == "to" || part == "on" ? std::string_view() : own_word(part);
      const auto meant = own.empty() ? repair::meanings_of(part) : std::vector{own};
      all.insert(all.end(), meant.begin(), meant.end());
    }
  return all;
}

bool is_file(std::string_view name) {
  constexpr auto endings = std::to_array<std::string_view>({".bas", ".orb", ".macro", ".svg"});
  return name.find_first_of(" =:()<>\"") == std::string_view::npos &&
         std::any_of(endings.begin(), endings.end(), [&](std::string_view one) {
           return name.size() > one.size() && has_ending(name, one);
         });
}

std::size_t file_end(const Tokens& line, std::size_t at) {
  std::string name;
  for (auto end = at; end < line.size(); ++end) {
    if (line[end].is_text() || (end > at && line[end].gap))
      break;
    name += line[end].text;
    const bool more = end + 1 < line.size() && !line[end + 1].gap &&
                      (line[end + 1].is_word() || line[end + 1].is("."));
    if (!more && is_file(name))
      return end + 1;
  }
  return at;
}

} // namespace orb::testing
