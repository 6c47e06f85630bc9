#include "testing/sighting.h"

#include "base/text/utf8.h"
#include "spec/colours.h"
#include "testing/texts.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace orb::testing {

std::string decimal(double value, int decimals) {
  return fmt::format("{:.{}f}", value, decimals);
}

std::string plain(double value, int decimals) {
  auto text = decimal(value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.'))
      text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

namespace {

/// A number with one decimal, or with as many as show that it exceeds `bound`.
std::string above(double value, double bound) {
  for (int decimals = 1; decimals < 6; ++decimals) {
    auto text = decimal(value, decimals);
    if (std::stod(text) > bound || value <= bound)
      return text;
  }
  return fmt::format("{}", value);
}

std::string speed_words(double cm_s) {
  return decimal(cm_s, 1) + " cm/s";
}

std::string color_words(vm::Color color) {
  for (const auto& row : spec::led_colours)
    if (color == vm::Color{row.red, row.green, row.blue})
      return std::string(row.name);
  return fmt::format("#{:02X}{:02X}{:02X}", color.red, color.green, color.blue);
}

double difference(vm::Color a, vm::Color b) {
  return std::max(
      {std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
}

double outside(double value, double least, double most) {
  return std::max({least - value, value - most, 0.0});
}

/// The angle between two headings, in degrees.
double turn(double from, double to) {
  const double way = std::abs(std::fmod(from - to, double{spec::ball::full_circle}));
  return std::min(way, spec::ball::full_circle - way);
}

/// Distance of the ball from the place, or from the other ball.
double apart(const Expectation& one, const Sighting& s) {
  const auto place = one.other_ball ? s.balls[*one.other_ball] : vm::Point{one.x, one.y};
  return std::hypot(s.x - place.x, s.y - place.y);
}

/// Distance between a sighting and one expectation; 0 if met.
double off_alone(const Expectation& one, const Meaning& meaning, const Sighting& s) {
  switch (one.word) {
  case Word::Near: return std::max(0.0, apart(one, s) - one.by);
  case Word::Beyond:
    switch (one.side) {
    case Side::AboveX: return s.x > one.most ? 0 : std::max(one.most - s.x, 1e-12);
    case Side::BelowX: return s.x < one.most ? 0 : std::max(s.x - one.most, 1e-12);
    case Side::AboveY: return s.y > one.most ? 0 : std::max(one.most - s.y, 1e-12);
    case Side::BelowY: return s.y < one.most ? 0 : std::max(s.y - one.most, 1e-12);
    }
    return 0;
  case Word::Inside:
  case Word::Stay: return meaning.zone->distance_cm({s.x, s.y});
  case Word::Heading: return std::max(0.0, turn(s.heading, one.most) - one.by);
  case Word::Speed: return outside(s.speed, one.least, one.most);
  case Word::Moving: return s.moving ? 0 : 1;
  case Word::Resting: return s.moving ? 1 + s.speed : s.has_moved || s.over ? 0 : infinite;
  case Word::Color: {
    double nearest = infinite;
    for (const auto color : one.colors)
      nearest = std::min(nearest, difference(s.color, color));
    return std::max(0.0, nearest - one.by);
  }
  case Word::BackLed: return outside(s.back, one.least, one.most);
  case Word::Asleep: return s.asleep ? 0 : 1;
  case Word::Print:
  case Word::Prints:
  case Word::Distance:
  case Word::Marker:
  case Word::Collision:
  case Word::Error:
  case Word::End:
  case Word::Lines:
  case Word::Bytes:
  case Word::Variable: break;
  }
  return 0;
}

/// Describes a sighting in the terms of one expectation.
Message describe_alone(const Expectation& one, const Meaning& meaning, const Sighting& s) {
  switch (one.word) {
  case Word::Near:
    return texts::Away(above(apart(one, s), one.by), one.other_ball
                                                         ? meaning.other_ball
                                                         : plain(one.x, 2) + "," + plain(one.y, 2));
  case Word::Beyond: {
    const bool x = one.side == Side::AboveX || one.side == Side::BelowX;
    return x ? texts::X(decimal(s.x, 1)) : texts::Y(decimal(s.y, 1));
  }
  case Word::Inside:
  case Word::Stay: {
    const double away = meaning.zone->distance_cm({s.x, s.y});
    return away == 0 ? texts::In(one.name.text) : texts::Away(above(away, 0), one.name.text);
  }
  case Word::Heading: return texts::Heading(plain(s.heading, 1));
  case Word::Speed: return Message::as_is(speed_words(s.speed));
  case Word::Resting:
    if (!s.moving && !s.has_moved && !s.over)
      return texts::NotMovedYet();
    [[fallthrough]];
  case Word::Moving: return s.moving ? texts::MovingAt(speed_words(s.speed)) : texts::Resting();
  case Word::Color: return Message::as_is(color_words(s.color));
  case Word::BackLed: return texts::BackLed(s.back);
  case Word::Asleep: return s.asleep ? texts::Asleep() : texts::Awake();
  case Word::Print:
  case Word::Prints:
  case Word::Distance:
  case Word::Marker:
  case Word::Collision:
  case Word::Error:
  case Word::End:
  case Word::Lines:
  case Word::Bytes:
  case Word::Variable: break;
  }
  return {};
}

bool is_state(const Expectation& one) {
  return info(one.word).kind == Kind::State || info(one.word).kind == Kind::Stay;
}

/// Maps to 0…1, so that centimetres and shades of colour can be added.
double share(double off) {
  return off == infinite ? 1 : off / (1 + off);
}

} // namespace

double off(const Expectation& one, const Meaning& meaning, const Sighting& s) {
  if (one.joined.empty())
    return off_alone(one, meaning, s);
  double sum = is_state(one) ? share(off_alone(one, meaning, s)) : 0;
  for (std::size_t i = 0; i < one.joined.size(); ++i)
    sum += share(off_alone(one.joined[i], meaning.joined[i], s));
  return sum;
}

Message describe(const Expectation& one, const Meaning& meaning, const Sighting& s) {
  auto all = is_state(one) ? describe_alone(one, meaning, s) : Message();
  for (std::size_t i = 0; i < one.joined.size(); ++i) {
    auto more = describe_alone(one.joined[i], meaning.joined[i], s);
    all = all.empty() ? std::move(more) : texts::And(std::move(all), std::move(more));
  }
  return all;
}

std::string shown_line(std::string_view line) {
  constexpr std::size_t longest_shown = 80;
  const auto text = to_printable(line.substr(0, longest_shown));
  return line.size() <= longest_shown ? text : text + "…";
}

} // namespace orb::testing
