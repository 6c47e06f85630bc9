#pragma once

// Trigonometry by operations that every processor rounds alike. What C libraries answer differs in
// the last bit, and a drive of a minute multiplies that: this way a trace is the same on Linux, on
// Windows and in a browser.

#include <cmath>

namespace orb::vm {

namespace series {

/// The sum of (-1)^n x^(2n+k) / (2n+k)! for small x, k being 0 or 1.
template <int k>
constexpr double alternating(double x) {
  constexpr int terms =
      9; // the tenth is below the last bit where |x| is at most a quarter turn's half
  double sum = 1;
  for (int n = terms; n > 0; --n) {
    const double i = 2 * n + k;
    sum = 1 - x * x / (i * (i - 1)) * sum;
  }
  return k == 0 ? sum : x * sum;
}

/// An angle as a number of quarter turns and what is left, at most half a one.
struct Quarters {
  int turned;
  double left;
};
inline Quarters quarters_of(double radians) {
  constexpr double quarter =
      0x1.921fb544p0; // of a turn, its first 33 bits: products with small numbers are exact
  constexpr double rest = 0x1.0b4611a626331p-34;      // what lacks of it
  constexpr double per_radian = 0x1.45f306dc9c883p-1; // 2 / pi
  constexpr double half = 0.5;
  const double n = std::floor(radians * per_radian + half);
  return {static_cast<int>(static_cast<long long>(n) & 3), (radians - n * quarter) - n * rest};
}

} // namespace series

/// Sine and cosine of an angle in radians, |angle| below 10^6; off by an ulp or two at most.
inline double sine(double radians) {
  const auto [turned, left] = series::quarters_of(radians);
  const double value =
      turned % 2 == 0 ? series::alternating<1>(left) : series::alternating<0>(left);
  return turned < 2 ? value : -value;
}
inline double cosine(double radians) {
  const auto [turned, left] = series::quarters_of(radians);
  const double value =
      turned % 2 == 0 ? series::alternating<0>(left) : series::alternating<1>(left);
  return turned == 0 || turned == 3 ? value : -value;
}

/// The angle in radians whose tangent is y / x, for x above 0.
inline double arctangent(double y, double x) {
  constexpr double bend = 0.28; // of a first guess that is good to a hundredth
  const double slope = y / x;
  const bool steep = std::abs(slope) > 1;
  const double flat = steep ? 1 / slope : slope;
  double angle = flat / (1 + bend * flat * flat);
  for (int i = 0; i < 3; ++i) { // Newton: each doubles the digits
    const double s = sine(angle);
    const double c = cosine(angle);
    angle -= (s - flat * c) / (c + flat * s);
  }
  constexpr double quarter = 0x1.921fb54442d18p0;
  return !steep ? angle : (slope > 0 ? quarter : -quarter) - angle;
}

/// The length of a way of a few metres: nothing overflows that std::hypot() would have to mind.
inline double length(double x, double y) {
  return std::sqrt(x * x + y * y);
}

} // namespace orb::vm
