#pragma once

// Trigonometry built only from operations that every processor rounds alike. C libraries differ in
// the last bit, and a minute of driving magnifies that; with this a trace is the same on Linux, on
// Windows and in a browser.

#include <cmath>

namespace orb::vm {

namespace series {

/// Sums (-1)^n x^(2n+k) / (2n+k)! for small x; k is 0 or 1.
template <int k>
constexpr double alternating(double x) {
  constexpr int terms = 9; // the tenth is below the last bit for |x| up to an eighth of a turn
  double sum = 1;
  for (int n = terms; n > 0; --n) {
    const double i = 2 * n + k;
    sum = 1 - x * x / (i * (i - 1)) * sum;
  }
  return k == 0 ? sum : x * sum;
}

/// An angle as a number of quarter turns and a rest of at most half a quarter.
struct Quarters {
  int turned;
  double left;
};
inline Quarters quarters_of(double radians) {
  constexpr double quarter =
      0x1.921fb544p0; // the first 33 bits of a quarter turn: products with small integers are exact
  constexpr double rest = 0x1.0b4611a626331p-34;      // the remaining bits of a quarter turn
  constexpr double per_radian = 0x1.45f306dc9c883p-1; // 2 / pi
  constexpr double half = 0.5;
  const double n = std::floor(radians * per_radian + half);
  return {static_cast<int>(static_cast<long long>(n) & 3), (radians - n * quarter) - n * rest};
}

} // namespace series

/// Sine and cosine of an angle in radians, |angle| below 10^6. The error is an ulp or two at most.
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

/// Returns the angle in radians whose tangent is y / x, for x above 0.
inline double arctangent(double y, double x) {
  constexpr double bend = 0.28; // of a first guess that is accurate to a hundredth
  const double slope = y / x;
  const bool steep = std::abs(slope) > 1;
  const double flat = steep ? 1 / slope : slope;
  double angle = flat / (1 + bend * flat * flat);
  for (int i = 0; i < 3; ++i) { // Newton: each round doubles the digits
    const double s = sine(angle);
    const double c = cosine(angle);
    angle -= (s - flat * c) / (c + flat * s);
  }
  constexpr double quarter = 0x1.921fb54442d18p0;
  return !steep ? angle : (slope > 0 ? quarter : -quarter) - angle;
}

/// Length of a vector of a few metres. It cannot overflow, so std::hypot() is not needed.
inline double length(double x, double y) {
  return std::sqrt(x * x + y * y);
}

} // namespace orb::vm
