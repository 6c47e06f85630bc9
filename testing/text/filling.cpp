#include "testing/text/filling.h"

#include "base/duration.h"
#include "base/text/text.h"
#include "repair/arrange.h"
#include "testing/text/vocabulary.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace orb::testing {
namespace {

constexpr std::string_view fronts = "within at during until after by for points seeds facing";

/// A number without trailing zeros.
std::string shortest(double value) {
  return fmt::format("{}", std::round(value * 1000) / 1000);
}

std::string in_cm(const Amount& amount) {
  return amount.is_bare() ? amount.number : shortest(amount.value() * amount.unit->in(unit::cm));
}

} // namespace

std::string time_of(const Amount& amount) {
  if (!amount.is_bare())
    return fmt::format("{}{}", amount.number, amount.unit->word);
  constexpr double most_seconds = 100;
  const auto number = std::min(amount.value(), 1e9);
  return time_text(std::lround(number < most_seconds ? number * 1000 : number));
}

std::string in_circle(const std::string& degrees) {
  constexpr int circle = spec::ball::full_circle;
  const auto angle = parse_number<int>(degrees);
  return angle ? std::to_string((*angle % circle + circle) % circle) : degrees;
}

std::string file_of(const Piece& piece) {
  auto name = piece.is(Piece::File) ? piece.text : is_file(piece.inner) ? piece.inner : "";
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

const Piece* Filling::front(std::size_t at) const {
  while (at-- > 0) {
    const auto& piece = pieces_[at];
    if (at == subject_ || !piece.is(Piece::Word))
      return nullptr;
    if (piece.means_any(fronts))
      return &piece;
    if (!piece.says_nothing())
      return nullptr;
  }
  return nullptr;
}

bool Filling::has_front(std::size_t at, std::string_view meanings) const {
  const auto* const word = front(at);
  return word != nullptr && word->means_any(meanings);
}

/// True if no word says what a piece is for, or only one that may be left out.
bool Filling::is_free(std::size_t at) const {
  const auto* const word = front(at);
  return word == nullptr || word->says_nothing();
}

bool Filling::is_number(std::size_t at) const {
  return pieces_[at].is(Piece::Number) && pieces_[at].most.is_bare() && !pieces_[at].is_count;
}

const Piece& Filling::take(std::size_t at) {
  used_[at] = true;
  if (const auto* const word = front(at))
    used_[static_cast<std::size_t>(word - pieces_.data())] = true;
  return pieces_[at];
}

template <class Fits>
std::size_t Filling::find(Fits fits) const {
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    if (!used_[i] && fits(i))
      return i;
  return none;
}

/// Writes an amount in one of the units; nothing if it measures something else.
std::optional<std::string> Filling::written(const Amount& amount, std::span<const Unit> units) {
  const auto& first = units.front();
  if (amount.is_bare()) {
    sure_ = sure_ && first.word.empty();
    return fmt::format("{}{}", amount.number, first.word);
  }
  if (find_unit(amount.unit->word, units) != nullptr)
    return fmt::format("{}{}", amount.number, amount.unit->word);
  if (amount.is(Measure::Length) && first.measure == Measure::Speed)
    return fmt::format("{}{}/s", amount.number, amount.unit->word);
  if (amount.unit->measure != first.measure)
    return std::nullopt;
  return fmt::format("{}{}", std::lround(amount.value() * amount.unit->in(first)), first.word);
}

std::optional<std::string> Filling::fill(const Slots& slots, std::size_t subject) {
  subject_ = subject;
  if (subject < pieces_.size())
    use(subject);
  std::string all;
  for (const auto& slot : slots) {
    if (slot.kind == slot::Kind::Rest)
      continue; // the reader accepts it
    auto text = value(slot);
    if (!text && slot.may_lack)
      continue;
    if (!text && slot.before == "by") { // same as on the line above
      text = slot.kind == slot::Kind::Length ? elsewhere_.near_by : elsewhere_.heading_by;
      sure_ = false;
      if (const auto by = find([&](std::size_t i) { return pieces_[i].text == slot.before; });
          by != none)
        use(by);
    }
    if (!text || text->empty())
      return std::nullopt;
    for (; text; text = slot.repeats ? value(slot) : std::nullopt)
      all += fmt::format(" {}{}{}", slot.before, slot.before.empty() ? "" : " ", *text);
  }
  return all;
}

std::optional<std::string> Filling::number(const Slot& slot) {
  const auto is_open = [&](std::size_t i) {
    const auto& piece = pieces_[i];
    const auto value = piece.most.value();
    return piece.is(Piece::Number) && !piece.is_count &&
           (piece.most.is_bare() || piece.most.is(Measure::Angle) ||
            piece.most.is(Measure::Percent)) &&
           (slot.before != "by" ||
            (value >= static_cast<double>(slot.least) && value <= static_cast<double>(slot.most)));
  };
  const bool has_word = !slot.before.empty() && is_letter(slot.before[0]);
  auto at = find([&](std::size_t i) {
    return has_word             ? is_open(i) && has_front(i, slot.before)
           : slot.before == "<" ? is_number(i) && pieces_[i].sign == "<"
           : slot.before == "="
               ? is_number(i) && (pieces_[i].sign == "=" || (i > 0 && pieces_[i - 1].means("=")))
               : is_open(i) && is_free(i) &&
                     pieces_[i].sign.find_first_of("<>") == std::string::npos;
  });
  if (at == none && slot.before == "by") {
    at = find([&](std::size_t i) {
      return is_open(i) && (front(i) == nullptr || !equal_words(front(i)->text, "at"));
    });
    sure_ = sure_ && (at == none || front(at) != nullptr);
  }
  if (at == none)
    return std::nullopt;
  const auto& amount = take(at).most;
  if (slot.kind == slot::Kind::Whole && amount.number.find('.') != std::string::npos)
    return std::nullopt;
  return slot.most == spec::ball::full_circle - 1 ? in_circle(amount.number) : amount.number;
}

/// Takes two numbers; sets the tolerance aside.
std::optional<std::string> Filling::place() {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    if (is_number(i) || (pieces_[i].is(Piece::Number) && pieces_[i].most.is(Measure::Length)))
      if (!used_[i] && !has_front(i, "seeds points for facing"))
        all.push_back(i);
  const auto set_aside = [&](auto is_it) {
    const auto at = std::find_if(all.begin(), all.end(), is_it);
    if (by_ != none || at == all.end())
      return;
    by_ = *at;
    all.erase(at);
  };
  const auto is_length = [&](std::size_t i) { return pieces_[i].most.is(Measure::Length); };
  const bool one_length = std::count_if(all.begin(), all.end(), is_length) == 1;
  set_aside([&](std::size_t i) { return pieces_[i].sign.starts_with('<'); });
  set_aside([&](std::size_t i) { return one_length && is_length(i); });
  set_aside(
      [&](std::size_t i) { return has_front(i, "by within") && (!is_free(i) || is_length(i)); });
  set_aside(is_length);
  set_aside([&](std::size_t i) { return all.size() == 3 && i == all[2]; }); // `near 90 90 15`
  if (all.size() == 1 && !is_length(all[0])) { // `near 90.90`: a point in place of the comma
    const auto& said = take(all[0]).most.number;
    const auto point = said.find('.');
    sure_ = false;
    return point == std::string::npos
               ? std::nullopt
               : std::optional(said.substr(0, point) + "," + said.substr(point + 1));
  }
  if (all.size() != 2)
    return std::nullopt;
  // A tolerance below 1 is in metres, and then so is the place.
  constexpr double few = 10;
  auto* const by = by_ == none ? nullptr : &pieces_[by_].most;
  const bool metres =
      by != nullptr && by->value() < 1 && (by->is_bare() || by->unit->word == unit::m.word) &&
      std::all_of(all.begin(), all.end(),
                  [&](std::size_t i) { return std::abs(pieces_[i].most.value()) < few; });
  if (metres)
    *by = {shortest(by->value() * unit::m.in(unit::cm)), &unit::cm};
  std::string text;
  for (const auto i : all) {
    auto amount = take(i).most;
    if (metres && amount.is_bare() && amount.value() != 0) {
      amount.unit = &unit::m;
      sure_ = false;
    }
    text += (text.empty() ? "" : ",") + in_cm(amount);
  }
  return text;
}

std::optional<std::string> Filling::side(const Slot& slot) {
  const auto at = find([&](std::size_t i) {
    return is_number(i) || (pieces_[i].is(Piece::Number) && pieces_[i].most.is(Measure::Length));
  });
  const auto word = find(
      [&](std::size_t i) { return holds("x y", pieces_[i].text) && pieces_[i].is(Piece::Word); });
  if (at == none || (pieces_[at].axis == '\0' && word == none))
    return std::nullopt;
  if (pieces_[at].axis == '\0')
    pieces_[at].axis = take(word).text[0];
  const auto& piece = take(at);
  const auto cm = in_cm(piece.most);
  const bool told = !piece.sign.empty() && piece.sign != "=";
  if (slot.words == "=")
    return fmt::format("{}={}", piece.axis, cm);
  sure_ = sure_ && told;
  return fmt::format("{}{}{}", piece.axis, told ? piece.sign[0] : cm[0] == '-' ? '<' : '>', cm);
}

/// Takes the name of a zone, a macro or a variable.
std::optional<std::string> Filling::name() {
  const auto is_name = [&](std::size_t i) {
    return (pieces_[i].is(Piece::Word) && !is_of_tests(pieces_[i].text)) ||
           !pieces_[i].inner.empty();
  };
  auto at = find([&](std::size_t i) { return is_name(i) && pieces_[i].meanings.empty(); });
  if (at == none)
    at = find([&](std::size_t i) {
      return is_name(i) && !pieces_[i].says_nothing() && !pieces_[i].means("expect");
    });
  if (at == none)
    at = find([&](std::size_t i) { return is_name(i) && i == subject_ + 1; });
  if (at == none)
    return std::nullopt;
  const auto& piece = pieces_[at];
  used_[at] = true;
  return piece.inner.empty() || piece.inner.find(' ') != std::string::npos ? piece.text
                                                                           : piece.inner;
}

std::optional<std::string> Filling::range(const Slot& slot) {
  const auto& unit = slot.units.front();
  const auto fits = [&](std::size_t i) {
    const auto& amount = pieces_[i].most;
    return !pieces_[i].is_count && (amount.is_bare() || amount.unit->measure == unit.measure ||
                                    (amount.is(Measure::Length) && unit.measure == Measure::Speed));
  };
  auto first = find([&](std::size_t i) { return pieces_[i].is(Piece::Span) && fits(i); });
  auto second = first;
  if (first == none) { // `>= 8m and <= 10m`, `3m 5m`
    const auto is_bound = [&](std::size_t i, char other) {
      return pieces_[i].is(Piece::Number) && fits(i) && is_free(i) &&
             !pieces_[i].sign.starts_with(other);
    };
    first = find([&](std::size_t i) { return is_bound(i, '<'); });
    second = find([&](std::size_t i) { return i != first && is_bound(i, '>'); });
  }
  const auto only = first == none ? second : second == none ? first : none;
  if (first == none && second == none)
    return std::nullopt;
  if (only != none) {
    const auto& piece = take(only);
    const auto& amount = piece.most;
    const bool bare = unit.word.empty();
    if (piece.sign.starts_with('<') && (bare || !amount.is_bare()))
      return fmt::format("0{}..{}", unit.word, *written(amount, slot.units));
    if (piece.sign.starts_with('>') && slot.is_limited())
      return fmt::format("{}..{}", amount.number, slot.most);
    if ((!piece.sign.empty() && piece.sign != "=") || amount.is_bare() != bare)
      return std::nullopt; // no upper bound
    if (bare)
      return fmt::format("{0}..{0}", amount.number);
    constexpr double tenth = 0.1;
    const auto steps = amount.value() * amount.unit->in(unit);
    sure_ = false;
    return fmt::format("{0}{2}..{1}{2}", std::lround(steps * (1 - tenth)),
                       std::lround(steps * (1 + tenth)), unit.word);
  }
  auto low = pieces_[first].is(Piece::Span) ? pieces_[first].least : pieces_[first].most;
  auto high = take(second).most;
  take(first);
  for (auto i = first; i < second; ++i)
    used_[i] = used_[i] || pieces_[i].means("and");
  if (low.is_bare())
    low.unit = high.unit;
  if (high.is_bare())
    high.unit = low.unit;
  constexpr double most_metres = 30;
  if (low.is_bare() && unit.measure == Measure::Length) {
    sure_ = false;
    low.unit = high.unit = high.value() < most_metres ? &unit::m : &unit::cm;
  }
  const auto least = written(low, slot.units);
  const auto most = written(high, slot.units);
  if (!least || !most)
    return std::nullopt;
  const bool once = low.is_bare() || (low.unit == high.unit && low.is(Measure::Speed));
  return fmt::format("{}..{}", once ? low.number : *least, *most);
}

std::optional<std::string> Filling::colour() {
  const auto is_colour = [&](std::size_t i) { return !pieces_[i].colour.empty(); };
  const auto exact = [&](std::size_t i) { return is_colour(i) && pieces_[i].text[0] == '#'; };
  if (const auto at = find(is_colour); at != none) {
    use(at);
    const auto other = pieces_[at].text[0] == '#' ? none : find(exact); // `pink (#FF288C)`
    if (other != none)
      use(other);
    return pieces_[other != none ? other : at].colour;
  }
  const auto zero =
      find([&](std::size_t i) { return is_number(i) && pieces_[i].most.number == "0"; });
  if (zero == none || subject_ == none)
    return std::nullopt;
  use(zero);
  return "off";
}

std::optional<std::string> Filling::seeds() {
  const bool says = subject_ < pieces_.size() && pieces_[subject_].means("seeds");
  const auto at = find([&](std::size_t i) {
    return ((pieces_[i].is(Piece::Span) && pieces_[i].most.is_bare()) || is_number(i)) &&
           (says || has_front(i, "seeds"));
  });
  if (at == none)
    return std::nullopt;
  const auto& piece = take(at);
  const auto next = find([&](std::size_t i) { return i > at && is_number(i) && says; });
  const auto& last = next == none || piece.is(Piece::Span) ? piece : take(next); // `seeds 1, 20`
  return fmt::format("{}..{}", piece.is(Piece::Span) ? piece.least.number : piece.most.number,
                     last.most.number);
}

std::optional<std::string> Filling::value(const Slot& slot) {
  const auto text_at = [&](std::size_t at) {
    return at == none ? std::nullopt : std::optional(take(at).text);
  };
  switch (slot.kind) {
  case slot::Kind::Number:
  case slot::Kind::Whole: return number(slot);
  case slot::Kind::Range: return range(slot);
  case slot::Kind::Place: return place();
  case slot::Kind::Axis: return side(slot);
  case slot::Kind::Zone:
  case slot::Kind::Variable: return name();
  case slot::Kind::Colour: return colour();
  case slot::Kind::Seeds: return seeds();
  case slot::Kind::Match:
    return text_at(find([&](std::size_t i) { return pieces_[i].is(Piece::Text); }));
  case slot::Kind::Text:
    return text_at(find([&](std::size_t i) { return pieces_[i].text.starts_with('"'); }));
  case slot::Kind::Length: {
    const auto at = by_ != none ? by_ : find([&](std::size_t i) {
      return pieces_[i].is(Piece::Number) && pieces_[i].most.is(Measure::Length);
    });
    return at == none ? std::nullopt : written(take(at).most, slot.units);
  }
  case slot::Kind::Time: {
    const auto at = find([&](std::size_t i) {
      return (pieces_[i].is_time() || is_number(i)) &&
             (slot.before.empty() || has_front(i, slot.before));
    });
    if (at == none)
      return std::nullopt;
    sure_ = sure_ && !pieces_[at].most.is_bare();
    return time_of(take(at).most);
  }
  case slot::Kind::File: {
    const auto at = find([&](std::size_t i) { return !file_of(pieces_[i]).empty(); });
    return at == none ? std::nullopt : std::optional(file_of(take(at)));
  }
  case slot::Kind::Choice:
    for (const auto word : slot.choices())
      if (const auto at = find([&](std::size_t i) {
            return equal_words(pieces_[i].text, word) || repair::is_called(word, pieces_[i].text);
          });
          at != none) {
        use(at);
        return std::string(word);
      }
    return std::nullopt;
  case slot::Kind::Macro: {
    const auto macro = find([&](std::size_t i) { return pieces_[i].text == slot.before; });
    auto found = name();
    if (found && macro != none)
      use(macro);
    return found;
  }
  case slot::Kind::TimeSpan:
  case slot::Kind::Word:
  case slot::Kind::Version:
  case slot::Kind::Firmware:
  case slot::Kind::Rest: break;
  }
  return std::nullopt;
}

std::string Filling::take_times() {
  const auto at = find([&](std::size_t i) { return pieces_[i].is_count; });
  if (at == none)
    return {};
  const auto& piece = take(at);
  const auto least = piece.is(Piece::Span) ? piece.least.number + " to " : std::string();
  return fmt::format(" {}{} times", least, piece.most.number);
}

std::string Filling::take_count() {
  const auto at =
      find([&](std::size_t i) { return is_number(i) && is_free(i) && pieces_[i].axis == '\0'; });
  if (at == none)
    return {};
  sure_ = false;
  return fmt::format(" {} times", take(at).most.number);
}

std::string Filling::take_name() {
  const auto at = find([&](std::size_t i) { return is_number(i) || pieces_[i].is(Piece::Text); });
  if (at == none)
    return {};
  const auto& piece = take(at);
  return " " + (piece.is(Piece::Text) ? piece.text : piece.most.number);
}

bool Filling::take_when(std::optional<SaidWhen>& when, std::string& lasts) {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const auto& piece = pieces_[i];
    if (used_[i])
      continue;
    const auto* const word = front(i);
    const bool ends = piece.is(Piece::Word) && piece.means("end") &&
                      (i + 1 == pieces_.size() || has_front(i, "at"));
    const bool bare = is_number(i) && piece.axis == '\0' && has_front(i, "within at until after") &&
                      (!is_free(i) || has_front(i, "within"));
    const bool span = piece.is(Piece::Span) && piece.most.is(Measure::Time) && !piece.is_count;
    if (!ends && !bare && !span && !piece.is_time())
      continue;
    take(i);
    sure_ = sure_ && !bare;
    SaidWhen one{"at", "end"};
    if (span)
      one = {"during", fmt::format("{}..{}", time_of(piece.least), time_of(piece.most))};
    else if (!ends)
      one = {"", time_of(piece.most)};
    for (const auto* meaning : {"within", "at", "until", "after", "for"})
      if (one.word.empty() && word != nullptr && word->means(meaning))
        one.word = meaning;
    if (one.word.empty() && (piece.sign.starts_with('<') || has_front(i, "by")))
      one.word = "within";
    if (one.word.empty() && word != nullptr && word->text == "during")
      return false; // no start
    if (piece.sign.starts_with('>') || (when && one.word != "for") ||
        (one.word == "for" && !lasts.empty()))
      return false;
    if (one.word == "for")
      lasts = one.time;
    else
      when = one;
  }
  return true;
}

std::string Filling::take_moment(const Slots& slots) {
  const bool takes_time = !slots.empty() && slots[0].kind == slot::Kind::Time;
  const auto stands_first = [&](std::size_t i) {
    return std::all_of(pieces_.begin(), pieces_.begin() + static_cast<std::ptrdiff_t>(i),
                       [](const Piece& piece) { return piece.says_nothing(); });
  };
  auto at =
      find([&](std::size_t i) { return pieces_[i].is_time() && has_front(i, "at within after"); });
  if (at == none)
    at = find(
        [&](std::size_t i) { return pieces_[i].is_time() && (!takes_time || stands_first(i)); });
  if (at == none)
    at = find([&](std::size_t i) {
      return is_number(i) &&
             ((front(i) != nullptr && equal_words(front(i)->text, "at")) || stands_first(i));
    });
  if (at == none)
    return {};
  sure_ = sure_ && !pieces_[at].most.is_bare();
  return fmt::format("at {} ", time_of(take(at).most));
}

bool Filling::is_empty(std::string_view word) const {
  return find([&](std::size_t i) {
           const auto& piece = pieces_[i];
           return !piece.says_nothing() && !piece.means(word) && piece.text != word &&
                  piece.text != "," && !piece.means_any("expect program ball between count =") &&
                  !equal_words(piece.text, "true");
         }) == none;
}

} // namespace orb::testing
