#include "testing/text/filling.h"

#include "base/duration.h"
#include "base/text/text.h"
#include "repair/arrange.h"
#include "testing/text/vocabulary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace orb::testing {
namespace {

constexpr std::string_view fronts = "within at during until after by for points seeds facing";

/// A number as it is written, without zeros that say nothing.
std::string plain(double value) {
  return fmt::format("{}", std::round(value * 1000) / 1000);
}

} // namespace

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

/// Whether no word says what a piece is for, or one that may say nothing.
bool Filling::is_free(std::size_t at) const {
  const auto* const word = front(at);
  return word == nullptr || word->says_nothing();
}

void Filling::take(std::size_t at) {
  used_[at] = true;
  if (const auto* const word = front(at))
    used_[static_cast<std::size_t>(word - pieces_.data())] = true;
}

template <class Fits>
std::size_t Filling::find(Fits fits) const {
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    if (!used_[i] && fits(i))
      return i;
  return none;
}

bool Filling::is_number(std::size_t at) const {
  return pieces_[at].is(Piece::Number) && pieces_[at].most.is_bare() && !pieces_[at].is_count;
}

std::optional<std::string> Filling::written(const Amount& amount, std::span<const Unit> units) {
  if (amount.is_bare()) {
    sure_ = sure_ && units.front().word.empty();
    return fmt::format("{}{}", amount.number, units.front().word);
  }
  if (find_unit(amount.unit->word, units) != nullptr)
    return fmt::format("{}{}", amount.number, amount.unit->word);
  if (amount.is(Measure::Length) && units.front().measure == Measure::Speed)
    return fmt::format("{}{}/s", amount.number, amount.unit->word);
  if (amount.unit->measure != units.front().measure)
    return std::nullopt;
  return fmt::format("{}{}", std::lround(amount.value() * amount.unit->in(units.front())),
                     units.front().word);
}

std::string Filling::time(const Amount& amount) {
  if (!amount.is_bare())
    return fmt::format("{}{}", amount.number, amount.unit->word);
  constexpr double most_seconds = 100; // a larger number without a unit is milliseconds
  sure_ = false;
  const auto number = std::min(amount.value(), 1e9);
  return time_text(std::lround(number < most_seconds ? number * 1000 : number));
}

std::optional<std::string> Filling::fill(const Slots& slots, std::size_t subject) {
  subject_ = subject;
  if (subject < pieces_.size())
    use(subject);
  std::string all;
  for (const auto& slot : slots) {
    if (slot.kind == slot::Kind::Rest)
      continue; // its language reads it
    auto text = value(slot);
    if (!text && slot.may_lack)
      continue;
    if (!text && slot.before == "by") { // as in the line above
      text = slot.kind == slot::Kind::Length ? elsewhere_.near_by : elsewhere_.heading_by;
      sure_ = false;
    }
    if (!text || text->empty())
      return std::nullopt;
    all += fmt::format(" {}{}{}", slot.before, slot.before.empty() ? "" : " ", *text);
    if (slot.repeats)
      for (auto more = value(slot); more; more = value(slot))
        all += " " + *more;
  }
  return all;
}

/// Where the number stands that belongs into a slot of numbers.
std::size_t Filling::amount_for(const Slot& slot) const {
  const auto has_front = [&](std::size_t i) {
    return pieces_[i].is(Piece::Number) && front(i) != nullptr && front(i)->means(slot.before) &&
           !pieces_[i].is_time() && !pieces_[i].most.is(Measure::Length);
  };
  const auto is_open = [&](std::size_t i) {
    return pieces_[i].is(Piece::Number) && !pieces_[i].is_count && !pieces_[i].is_time() &&
           !pieces_[i].most.is(Measure::Length) && pieces_[i].sign != "<" &&
           pieces_[i].sign != ">" && (!slot.before.empty() || is_free(i));
  };
  const bool by_word = !slot.before.empty() && is_letter(slot.before[0]);
  if (const auto at = by_word ? find(has_front) : none; at != none)
    return at;
  if (slot.before == "by")
    return find([&](std::size_t i) {
      return is_open(i) && (front(i) == nullptr || !equal_words(front(i)->text, "at"));
    });
  if (slot.before == "<")
    return find([&](std::size_t i) { return is_number(i) && pieces_[i].sign == "<"; });
  if (slot.before == "=")
    return find([&](std::size_t i) {
      return is_number(i) && (pieces_[i].sign == "=" || (i > 0 && pieces_[i - 1].means("=")));
    });
  return by_word ? none : find(is_open);
}

std::optional<std::string> Filling::number(const Slot& slot) {
  const auto at = amount_for(slot);
  if (at == none)
    return std::nullopt;
  const auto& amount = pieces_[at].most;
  sure_ = sure_ && (slot.before != "by" || front(at) != nullptr);
  take(at);
  const bool turns = slot.least == 0 && slot.most == spec::ball::full_circle - 1;
  const auto value = amount.value();
  if (slot.kind == slot::Kind::Whole && value != std::trunc(value))
    return std::nullopt;
  if (turns && std::abs(value) < spec::ball::full_circle * 100.0) {
    const auto angle = static_cast<int>(value) % spec::ball::full_circle;
    return std::to_string((angle + spec::ball::full_circle) % spec::ball::full_circle);
  }
  return amount.number;
}

/// Two numbers; the one with the tolerance is set aside.
std::optional<std::string> Filling::place() {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    if (!used_[i] && pieces_[i].is(Piece::Number) && !pieces_[i].is_count &&
        !pieces_[i].is_time() && (pieces_[i].most.is_bare() || pieces_[i].most.is(Measure::Length)))
      all.push_back(i);
  const auto set_aside = [&](auto is_it) {
    for (auto at = all.begin(); at != all.end() && by_ == none; ++at)
      if (is_it(*at)) {
        by_ = *at;
        all.erase(at);
        break;
      }
  };
  set_aside([&](std::size_t i) { return pieces_[i].sign.starts_with('<'); });
  set_aside([&](std::size_t i) { return front(i) != nullptr && !is_free(i); });
  set_aside(
      [&](std::size_t i) { return front(i) != nullptr && pieces_[i].most.is(Measure::Length); });
  set_aside([&](std::size_t i) { return pieces_[i].most.is(Measure::Length); });
  if (by_ == none && all.size() == 3) { // `near 90 90 15`
    by_ = all.back();
    all.pop_back();
  }
  if (all.size() == 1 && pieces_[all[0]].most.is_bare()) // `near 90.90`: a point for a comma
    if (const auto& said = pieces_[all[0]].most.number; said.find('.') != std::string::npos) {
      sure_ = false;
      use(all[0]);
      return fmt::format("{},{}", said.substr(0, said.find('.')), said.substr(said.find('.') + 1));
    }
  if (all.size() != 2)
    return std::nullopt;
  // A tolerance below 1 is in metres, and so is the place then.
  auto* const by = by_ == none ? nullptr : &pieces_[by_].most;
  const auto is_small = [&](std::size_t i) { return std::abs(pieces_[i].most.value()) < 10; };
  const bool metres = by != nullptr && by->value() < 1 &&
                      (by->is_bare() || by->unit->word == unit::m.word) && is_small(all[0]) &&
                      is_small(all[1]);
  if (metres)
    *by = {plain(by->value() * 100), &unit::cm};
  std::string text;
  for (const auto i : all) {
    const auto& amount = pieces_[i].most;
    const bool far = metres && amount.is_bare() && amount.value() != 0;
    sure_ = sure_ && !far;
    text += text.empty() ? "" : ",";
    text += far                ? plain(amount.value() * 100)
            : amount.is_bare() ? amount.number
                               : plain(amount.value() * amount.unit->in(unit::cm));
    used_[i] = true;
  }
  return text;
}

std::optional<std::string> Filling::side(const Slot& slot) {
  const auto at = find([&](std::size_t i) {
    return pieces_[i].is(Piece::Number) && !pieces_[i].is_count &&
           (pieces_[i].most.is_bare() || pieces_[i].most.is(Measure::Length));
  });
  if (at == none)
    return std::nullopt;
  auto axis = pieces_[at].axis;
  if (const auto word =
          find([&](std::size_t i) { return pieces_[i].text == "x" || pieces_[i].text == "y"; });
      axis == '\0' && word != none) {
    axis = pieces_[word].text[0];
    used_[word] = true;
  }
  if (axis == '\0')
    return std::nullopt;
  take(at);
  const auto& amount = pieces_[at].most;
  const auto cm =
      amount.is_bare() ? amount.number : plain(amount.value() * amount.unit->in(unit::cm));
  if (slot.words == "=")
    return fmt::format("{}={}", axis, cm);
  const auto& said = pieces_[at].sign;
  const bool told = said.starts_with('<') || said.starts_with('>');
  sure_ = sure_ && told;
  return fmt::format("{}{}{}", axis, told ? said[0] : cm[0] == '-' ? '<' : '>', cm);
}

/// The name of a zone or a variable.
std::optional<std::string> Filling::name() {
  const auto is_name = [&](std::size_t i) {
    return (pieces_[i].is(Piece::Word) && !is_of_tests(pieces_[i].text)) ||
           (pieces_[i].is(Piece::Text) && !pieces_[i].inner.empty());
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
  used_[at] = true;
  const auto& piece = pieces_[at];
  return piece.is(Piece::Text) && piece.inner.find(' ') == std::string::npos ? piece.inner
                                                                             : piece.text;
}

std::optional<std::string> Filling::range(const Slot& slot) {
  const auto fits = [&](const Amount& amount) {
    return amount.is_bare() || amount.unit->measure == slot.units.front().measure ||
           (amount.is(Measure::Length) && slot.units.front().measure == Measure::Speed);
  };
  const auto is_value = [&](std::size_t i) {
    return pieces_[i].is(Piece::Number) && !pieces_[i].is_count && fits(pieces_[i].most) &&
           is_free(i);
  };
  auto least = find([&](std::size_t i) {
    return pieces_[i].is(Piece::Span) && !pieces_[i].is_count && fits(pieces_[i].most);
  });
  auto most = least;
  if (least == none) { // `>= 8m and <= 10m`, `3m 5m`
    least = find([&](std::size_t i) { return is_value(i) && !pieces_[i].sign.starts_with('<'); });
    most = find([&](std::size_t i) {
      return is_value(i) && i != least && !pieces_[i].sign.starts_with('>');
    });
  }
  if (least == none)
    return std::nullopt;
  take(least);
  auto low = pieces_[least].is(Piece::Span) ? pieces_[least].least : pieces_[least].most;
  if (most == none) {
    const auto& sign = pieces_[least].sign;
    const bool whole = slot.units.front().word.empty();
    if (sign.starts_with('<') && (whole || !low.is_bare()))
      return fmt::format("0{}..{}", slot.units.front().word, *written(low, slot.units));
    if (sign.starts_with('>') && slot.is_limited())
      return fmt::format("{}..{}", low.number, slot.most);
    if (!sign.empty() && sign != "=")
      return std::nullopt; // up to which?
    if (low.is_bare() != whole)
      return std::nullopt;
    if (whole)
      return fmt::format("{0}..{0}", low.number);
    constexpr double tenth = 0.1;
    const auto cm = low.value() * low.unit->in(slot.units.front());
    sure_ = false;
    return fmt::format("{0}{2}..{1}{2}", std::lround(cm * (1 - tenth)),
                       std::lround(cm * (1 + tenth)), slot.units.front().word);
  }
  take(most);
  for (auto i = least; i < most; ++i)
    used_[i] = used_[i] || pieces_[i].means("and");
  auto high = pieces_[most].most;
  for (auto* one : {&low, &high})
    if (one->is_bare())
      one->unit = (one == &low ? high : low).unit;
  constexpr double most_metres = 30;
  if (low.is_bare() && slot.units.front().measure == Measure::Length) {
    sure_ = false;
    low.unit = high.unit = high.value() < most_metres ? &unit::m : &unit::cm;
  }
  const auto first = written(low, slot.units);
  const auto second = written(high, slot.units);
  const bool same = low.unit == high.unit && (low.is_bare() || low.is(Measure::Speed));
  return first && second ? std::optional(fmt::format("{}..{}", same ? low.number : *first, *second))
                         : std::nullopt;
}

std::optional<std::string> Filling::colour() {
  const auto is_colour = [&](std::size_t i) { return !pieces_[i].colour.empty() && i != subject_; };
  const auto at = find(is_colour);
  if (at == none && subject_ == none)
    return std::nullopt;
  if (at == none) {
    const auto zero =
        find([&](std::size_t i) { return is_number(i) && pieces_[i].most.number == "0"; });
    if (zero == none)
      return std::nullopt;
    used_[zero] = true;
    return "off";
  }
  used_[at] = true;
  const auto exact =
      find([&](std::size_t i) { return is_colour(i) && pieces_[i].text.starts_with('#'); });
  if (exact == none)
    return pieces_[at].colour;
  used_[exact] = true; // `pink (#FF288C)`
  return pieces_[exact].colour;
}

std::optional<std::string> Filling::seeds() {
  const auto at = find([&](std::size_t i) {
    return (pieces_[i].is(Piece::Span) || is_number(i)) &&
           (subject_ < pieces_.size() ? pieces_[subject_].means("seeds") ||
                                            (front(i) != nullptr && front(i)->means("seeds"))
                                      : false);
  });
  if (at == none)
    return std::nullopt;
  take(at);
  const auto& piece = pieces_[at];
  auto next = find([&](std::size_t i) { return i == at + 1 && is_number(i); });
  if (piece.is(Piece::Number) && next != none) { // `seeds 1, 20`
    take(next);
    return fmt::format("{}..{}", piece.most.number, pieces_[next].most.number);
  }
  return fmt::format("{}..{}", piece.is(Piece::Span) ? piece.least.number : piece.most.number,
                     piece.most.number);
}

std::optional<std::string> Filling::value(const Slot& slot) {
  const auto kind = [&](Piece::Kind wanted) {
    return find([&](std::size_t i) { return pieces_[i].is(wanted); });
  };
  const auto text_of = [&](std::size_t at) -> std::optional<std::string> {
    if (at == none)
      return std::nullopt;
    take(at);
    return pieces_[at].text;
  };
  switch (slot.kind) {
  case slot::Kind::Number:
  case slot::Kind::Whole: return number(slot);
  case slot::Kind::Length: {
    const auto at = by_ != none ? by_ : find([&](std::size_t i) {
      return pieces_[i].is(Piece::Number) && pieces_[i].most.is(Measure::Length);
    });
    if (at == none)
      return std::nullopt;
    take(at);
    return written(pieces_[at].most, slot.units);
  }
  case slot::Kind::Range: return range(slot);
  case slot::Kind::Time: {
    const auto wanted = [&](std::size_t i) {
      const bool told = !slot.before.empty() && front(i) != nullptr && front(i)->means(slot.before);
      return slot.before.empty() ? pieces_[i].is_time() || is_number(i)
                                 : told && (pieces_[i].is_time() || is_number(i));
    };
    const auto at = find(wanted);
    if (at == none)
      return std::nullopt;
    take(at);
    return time(pieces_[at].most);
  }
  case slot::Kind::Place: return place();
  case slot::Kind::Axis: return side(slot);
  case slot::Kind::Match: return text_of(kind(Piece::Text));
  case slot::Kind::Text:
    return text_of(find([&](std::size_t i) {
      return !pieces_[i].inner.empty() && !pieces_[i].text.starts_with('~');
    }));
  case slot::Kind::File: {
    auto at = kind(Piece::File);
    if (at == none)
      at = find([&](std::size_t i) { return is_file(pieces_[i].inner); });
    if (at == none)
      return std::nullopt;
    used_[at] = true;
    auto name = pieces_[at].is(Piece::File) ? pieces_[at].text : pieces_[at].inner;
    std::replace(name.begin(), name.end(), '\\', '/');
    return name;
  }
  case slot::Kind::Choice: {
    const auto words = slot.choices();
    for (const auto word : words)
      if (const auto at = find([&](std::size_t i) {
            return pieces_[i].is(Piece::Word) &&
                   (equal_words(pieces_[i].text, word) || repair::is_called(word, pieces_[i].text));
          });
          at != none) {
        used_[at] = true;
        return std::string(word);
      }
    return std::nullopt;
  }
  case slot::Kind::Zone:
  case slot::Kind::Variable: return name();
  case slot::Kind::Macro: {
    const auto macro = find([&](std::size_t i) { return pieces_[i].text == "macro"; });
    if (macro == none)
      return name();
    if (macro + 1 == pieces_.size() || !pieces_[macro + 1].is(Piece::Word))
      return std::nullopt;
    used_[macro] = used_[macro + 1] = true;
    return pieces_[macro + 1].text;
  }
  case slot::Kind::Colour: return colour();
  case slot::Kind::Seeds: return seeds();
  case slot::Kind::TimeSpan:
  case slot::Kind::Word:
  case slot::Kind::Version:
  case slot::Kind::Firmware:
  case slot::Kind::Rest: break;
  }
  return std::nullopt;
}

std::string Filling::take_times() {
  auto at = find([&](std::size_t i) { return pieces_[i].is_count; });
  if (at == none) {
    at = find([&](std::size_t i) { return is_number(i) && is_free(i) && pieces_[i].axis == '\0'; });
    sure_ = sure_ && at == none;
  }
  if (at == none)
    return {};
  take(at);
  const auto& piece = pieces_[at];
  return piece.is(Piece::Span)
             ? fmt::format(" {} to {} times", piece.least.number, piece.most.number)
             : fmt::format(" {} times", piece.most.number);
}

bool Filling::take_when(std::optional<Moment>& when, std::string& lasts) {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const auto& piece = pieces_[i];
    if (used_[i])
      continue;
    const auto* const word = front(i);
    const bool at_end = piece.is(Piece::Word) && piece.means("end") &&
                        (i + 1 == pieces_.size() || (word != nullptr && word->means("at")));
    const bool strict = word != nullptr && !word->says_nothing();
    const bool bare =
        is_number(i) && word != nullptr && (strict || word->means("within")) && piece.axis == '\0';
    const bool span = piece.is(Piece::Span) && piece.most.is(Measure::Time) && !piece.is_count;
    if (!at_end && !bare && !span && !piece.is_time())
      continue;
    take(i);
    Moment one;
    if (at_end) {
      one = {"at", "end"};
    } else if (span) {
      one = {"during", fmt::format("{}..{}", time(piece.least), time(piece.most))};
    } else {
      one.time = time(piece.most);
      for (const auto meaning : {"within", "at", "until", "after", "for"})
        if (one.word.empty() && word != nullptr && word->means(meaning))
          one.word = meaning;
      if (one.word.empty() &&
          (piece.sign.starts_with('<') || (word != nullptr && word->means("by"))))
        one.word = "within";
      if (piece.sign.starts_with('>'))
        return false;
    }
    if (one.word == "for" && lasts.empty()) {
      lasts = one.time;
      continue;
    }
    if (when)
      return false;
    when = one;
  }
  return true;
}

std::string Filling::take_moment(bool takes_time) {
  const auto stands_first = [&](std::size_t i) {
    for (std::size_t before = 0; before < i; ++before)
      if (!pieces_[before].says_nothing())
        return false;
    return true;
  };
  auto at = find([&](std::size_t i) {
    return pieces_[i].is_time() && front(i) != nullptr && front(i)->means_any("at within after");
  });
  if (at == none)
    at = find(
        [&](std::size_t i) { return pieces_[i].is_time() && (!takes_time || stands_first(i)); });
  if (at == none)
    at = find([&](std::size_t i) {
      return is_number(i) && ((front(i) != nullptr && equal_words(front(i)->text, "at")) ||
                              (stands_first(i) && i + 1 < pieces_.size()));
    });
  if (at == none)
    return {};
  take(at);
  return "at " + time(pieces_[at].most) + " ";
}

bool Filling::is_empty(std::string_view word) const {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const auto& piece = pieces_[i];
    const bool says_again = piece.is(Piece::Word) && (piece.means(word) || piece.text == word);
    const bool is_sign = piece.is(Piece::Sign) && piece.text == ",";
    if (!used_[i] && !piece.says_nothing() && !says_again && !is_sign &&
        !(piece.is(Piece::Word) && (piece.means_any("expect program ball between count =") ||
                                    equal_words(piece.text, "true"))))
      return false;
  }
  return true;
}

} // namespace orb::testing
