#include "run/calibrate/fit.h"

#include "base/refuse.h"
#include "vm/body/angles.h"
#include "vm/body/body.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <unsupported/Eigen/NonLinearOptimization>
#include <vector>

namespace orb::run {
namespace {

constexpr std::size_t rows = driving_rows.size();
/// Parameters, as multiples of the model's.
using Vector = Eigen::VectorXd;
using Residuals = std::vector<double>;

constexpr double yaw_cm_per_deg = 0.2; ///< weight of a degree relative to places
constexpr double open_share = 0.15;    ///< a larger relative spread leaves a parameter undetermined
/// Largest share of the legs' extent that may remain unexplained. The model leaves up to 19 % of
/// public drives.
constexpr double misfit_share = 0.3;
constexpr double misfit_cm = 2;
constexpr std::size_t least_legs = 6;

Eigen::Index index(std::size_t row) {
  return static_cast<Eigen::Index>(row);
}

Vector each(double value) {
  return Vector::Constant(index(rows), value);
}

/// Converts a value to and from the search space. Grip is searched as its reciprocal, so that 0
/// means no slip.
double turned(const DrivingRow& row, double value) {
  return row.place == &spec::Driving::grip ? 1 / value : value;
}

/// Clamps `times` to the range that a profile may contain.
double in_range(const DrivingRow& row, const spec::Driving& model, double times) {
  const double one = turned(row, value_of(model, row));
  const auto [least, most] = std::minmax({turned(row, row.least), turned(row, row.most)});
  return std::clamp(times, least / one, most / one);
}

/// Returns the value in the unit of the row.
double value_at(const DrivingRow& row, const spec::Driving& model, double times) {
  return turned(row, in_range(row, model, times) * turned(row, value_of(model, row)));
}

/// Simulates a leg and returns the model's place at each sample.
void follow(const Leg& leg, const spec::Driving& numbers, std::vector<Seen>& places) {
  vm::Body body(1, numbers);
  auto order = leg.orders.begin();
  places.clear();
  for (const auto& seen : leg.seen) {
    for (; order != leg.orders.end() && order->at <= seen.at; ++order) {
      body.advance_to(Instant{} + order->at);
      body.obey(vm::Roll{order->heading_deg, order->speed, order->go});
    }
    body.advance_to(Instant{} + seen.at);
    places.push_back({seen.at, body.locator_cm(), body.yaw_deg()});
  }
}

/// The start of the part that counts: the robot has turned in place and is still at rest.
Duration counts_from(const Leg& leg) {
  constexpr Duration before = 150ms;
  return leg.orders[1].at - before;
}

/// Appends the errors of the model in cm. Subtracts the mean of the place errors, because all
/// samples together locate the start better than the first one.
void append_leg(const Leg& leg, const spec::Driving& numbers, Residuals& residuals) {
  std::vector<Seen> places;
  follow(leg, numbers, places);
  const auto from = counts_from(leg);
  vm::Point mean;
  double count = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i].at >= from) {
      mean.x += leg.seen[i].place_cm.x - places[i].place_cm.x;
      mean.y += leg.seen[i].place_cm.y - places[i].place_cm.y;
      ++count;
    }
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i].at >= from) {
      residuals.push_back(leg.seen[i].place_cm.x - places[i].place_cm.x - mean.x / count);
      residuals.push_back(leg.seen[i].place_cm.y - places[i].place_cm.y - mean.y / count);
      residuals.push_back(yaw_cm_per_deg *
                          vm::shortest_turn(places[i].yaw_deg, leg.seen[i].yaw_deg));
    }
}

/// Interpolates the residuals for a dead time between two steps of the control system. The
/// simulated order comes right after a step, a real one half a step later on average; hence the
/// 0.5.
Residuals residuals_of(const std::vector<const Leg*>& legs, const spec::Driving& model,
                       const Vector& at) {
  spec::Driving numbers;
  numbers = model;
  double steps = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const double value = value_at(driving_rows[row], model, at[index(row)]);
    if (driving_rows[row].place == nullptr)
      steps = std::clamp(value / dead_step_ms - 0.5, 0.0, spec::most_dead_steps - 1.0);
    else
      set_value(numbers, driving_rows[row], value);
  }
  Residuals below, above;
  for (const auto* leg : legs) {
    numbers.dead_steps = static_cast<int>(steps);
    append_leg(*leg, numbers, below);
    ++numbers.dead_steps;
    append_leg(*leg, numbers, above);
  }
  const double share = steps - std::floor(steps);
  for (std::size_t i = 0; i < below.size(); ++i)
    below[i] += share * (above[i] - below[i]);
  return below;
}

/// Strengths of the pull toward the model's parameters: the cost in cm of being off by 100 %.
constexpr double pull_weak = 0.02; ///< decides only what the legs leave open
constexpr double pull_some = 0.5;  ///< keeps speed lines fitted to a single leg plausible
constexpr double pull_fast = 1e4;  ///< fixes the parameter

bool is_speed(const DrivingRow& row) {
  return row.place == &spec::Driving::speed_offset || row.place == &spec::Driving::speed_slope;
}

/// Fixes all parameters except those of the speed.
Vector speeds_only(double pull) {
  Vector pulls(index(rows));
  for (std::size_t row = 0; row < rows; ++row)
    pulls[index(row)] = is_speed(driving_rows[row]) ? pull : pull_fast;
  return pulls;
}

int top_speed(const Leg& leg) {
  return leg.orders[1].speed;
}

/// Residuals in the form that Eigen expects: those of the legs, then for each parameter its pull
/// toward the model's and the penalty for leaving its range.
struct Misfit {
  using Scalar = double;
  using InputType = Vector;
  using ValueType = Vector;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  int inputs() const { return static_cast<int>(rows); }
  int values() const { return static_cast<int>((*this)(each(1)).size()); }

  Vector operator()(const Vector& at) const {
    constexpr double edge = 100;
    auto residuals = residuals_of(*legs, *model, at);
    for (std::size_t row = 0; row < rows; ++row) {
      const double times = at[index(row)];
      residuals.push_back(pull[index(row)] * (times - 1));
      residuals.push_back(edge * (times - in_range(driving_rows[row], *model, times)));
    }
    return Eigen::Map<const Vector>(residuals.data(), index(residuals.size()));
  }
  int operator()(const Vector& at, Vector& out) const {
    out = (*this)(at);
    return 0;
  }
  int df(const Vector& at, Eigen::MatrixXd& slopes) const {
    constexpr double step = 0.02; // relative; less would measure noise of the stepwise physics
    for (Eigen::Index row = 0; row < index(rows); ++row) {
      slopes.col(row).setZero();
      slopes(slopes.rows() - 2 * index(rows) + 2 * row, row) = pull[row];
      if (pull[row] == pull_fast)
        continue;
      const Vector aside = step * Vector::Unit(index(rows), row);
      slopes.col(row) = ((*this)(at + aside) - (*this)(at - aside)) / (2 * step);
    }
    return 0;
  }

  const std::vector<const Leg*>* legs;
  const spec::Driving* model;
  Vector pull;
};

struct Found {
  Vector at = each(1);
  Vector spread;     ///< relative to the model's parameters
  double square = 0; ///< sum of squared residuals
  double noise = 0;  ///< mean squared residual
};

Vector lowest(const Misfit& misfit, Vector at) {
  Misfit copy = misfit; // Eigen needs a mutable object
  Eigen::LevenbergMarquardt<Misfit> search(copy);
  constexpr double close = 1e-5;
  search.parameters.ftol = close;
  search.parameters.xtol = close;
  search.parameters.maxfev = 400;
  search.minimize(at);
  return at;
}

Found lowest_and_spread(const Misfit& misfit, const Vector& start) {
  Found found;
  found.at = lowest(misfit, start);
  const Vector residuals = misfit(found.at);
  Eigen::MatrixXd slopes(residuals.size(), index(rows));
  misfit.df(found.at, slopes);
  found.square = residuals.squaredNorm();
  found.noise = found.square / static_cast<double>(residuals.size());
  const Eigen::MatrixXd curve = slopes.transpose() * slopes;
  found.spread = (curve.inverse().diagonal() * found.noise).cwiseAbs().cwiseSqrt();
  return found;
}

/// Root mean square error of the places.
double rms_cm(const Residuals& residuals) {
  double sum = 0;
  for (std::size_t i = 0; i + 2 < residuals.size(); i += 3)
    sum += residuals[i] * residuals[i] + residuals[i + 1] * residuals[i + 1];
  return residuals.empty() ? 0 : std::sqrt(sum * 3 / static_cast<double>(residuals.size()));
}

double error_cm(const std::vector<const Leg*>& legs, const spec::Driving& model, const Vector& at) {
  return rms_cm(residuals_of(legs, model, at));
}

/// Root mean square error without jitter: it keeps what changes slowly from one sample to the next
/// (John von Neumann's ratio).
double steady_cm(const Residuals& residuals) {
  double all = 0, trembling = 0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    all += residuals[i] * residuals[i];
    const double change = i < 3 ? 0 : residuals[i] - residuals[i - 3];
    trembling += change * change / 2;
  }
  return std::sqrt(std::max(0.0, all - trembling) * 3 / static_cast<double>(residuals.size()));
}

/// Extent of the legs: the error of a model that never moves.
double extent_cm(const std::vector<const Leg*>& legs) {
  spec::Driving still;
  still.speed_offset = still.speed_slope = 0;
  Residuals residuals;
  for (const auto* leg : legs)
    append_leg(*leg, still, residuals);
  for (std::size_t yaw = 2; yaw < residuals.size(); yaw += 3)
    residuals[yaw] = 0;
  return steady_cm(residuals);
}

/// Returns the legs that fit about as well as the others. A leg fits badly if an order was lost.
std::vector<const Leg*> fitting(const std::vector<const Leg*>& legs, const spec::Driving& model,
                                const Vector& at) {
  constexpr double much = 4;
  constexpr double little_cm = 1;
  std::vector<double> errors;
  for (const auto* leg : legs)
    errors.push_back(error_cm({leg}, model, at));
  auto sorted = errors;
  std::sort(sorted.begin(), sorted.end());
  const double most = std::max(little_cm, much * sorted[sorted.size() / 2]);
  std::vector<const Leg*> kept;
  for (std::size_t leg = 0; leg < legs.size(); ++leg)
    if (errors[leg] <= most)
      kept.push_back(legs[leg]);
  return kept;
}

std::vector<const Leg*> whole(std::span<const Leg> legs) {
  std::vector<const Leg*> found;
  for (const auto& leg : legs)
    if (!leg.broken)
      found.push_back(&leg);
  return found;
}

/// Relative spread of a parameter, of its own value or the model's, whichever is larger.
double openness(const Found& found, std::size_t row) {
  return found.spread[index(row)] / std::max(found.at[index(row)], 1.0);
}

/// Half the distance between the values one spread below and above, in the unit of the row.
double spread_of(const Found& found, std::size_t row, const spec::Driving& model) {
  const double at = found.at[index(row)];
  const double spread = found.spread[index(row)];
  const auto& info = driving_rows[row];
  return std::abs(value_at(info, model, at + spread) - value_at(info, model, at - spread)) / 2;
}

/// Fits the parameters. While any is undetermined, fixes the least determined one at the model's
/// value; keeps it if the legs then fit much worse, for example the grip of a robot that never
/// slips.
Vector find(const std::vector<const Leg*>& legs, const spec::Driving& model, const Vector& start,
            Calibration& result) {
  constexpr double much = 25; // sigmas, squared
  Misfit misfit{&legs, &model, each(pull_weak)};
  auto found = lowest_and_spread(misfit, start);
  std::vector<std::size_t> open;
  for (std::size_t row = 0; row < rows; ++row) {
    result.spread[row] = spread_of(found, row, model);
    if (openness(found, row) > open_share)
      open.push_back(row);
  }
  while (!open.empty()) {
    const auto worst = std::max_element(open.begin(), open.end(), [&](auto a, auto b) {
      return openness(found, a) < openness(found, b);
    });
    const auto row = *worst;
    open.erase(worst);
    if (openness(found, row) <= open_share)
      break;
    auto without = misfit;
    without.pull[index(row)] = pull_fast;
    auto at = found.at;
    at[index(row)] = 1;
    const auto other = lowest_and_spread(without, at);
    if (other.square > found.square + much * found.noise)
      continue;
    result.open[row] = true;
    misfit = without;
    found = other;
    for (std::size_t other_row = 0; other_row < rows; ++other_row)
      if (!result.open[other_row])
        result.spread[other_row] = spread_of(found, other_row, model);
  }
  return found.at;
}

/// Says why no robot can have these parameters: one lies at the end of its range, give or take its
/// spread. Exceptions: a robot may respond at once, and a floor may be arbitrarily slippery.
std::string nonsense(const Calibration& result) {
  for (std::size_t row = 0; row < rows; ++row) {
    const auto& info = driving_rows[row];
    if (result.open[row] || info.place == &spec::Driving::grip)
      continue;
    const double value = value_of(result.after, info);
    const double spread = std::max(result.spread[row], 1e-6);
    const bool may_vanish = info.place == nullptr || info.place == &spec::Driving::speed_lag;
    if ((value - spread < info.least && !may_vanish) || value + spread > info.most)
      return fmt::format(
          "no robot has a `{}` of {:.4g}; check that `--robot` names this robot, and "
          "begin again",
          info.name, value);
  }
  return {};
}

/// Says why the parameters are not trustworthy; empty if they are. `misfit` is the unexplained part
/// of `extent`, both in cm.
std::string doubt(const Calibration& result, std::size_t whole, double misfit, double extent) {
  constexpr double least_extent_cm = 1;
  if (whole < least_legs)
    return fmt::format("only {} of {} legs are usable; the link lost the others; move closer to "
                       "the robot and try again",
                       whole, result.legs);
  if (extent < least_extent_cm)
    return "the robot hardly moved; check that nothing is holding it back, and begin again";
  if (misfit > misfit_cm && misfit > misfit_share * extent)
    return fmt::format("the model does not fit this drive: it leaves {:.1f} cm of {:.1f} cm "
                       "unexplained; check that the floor is level and not slippery and that "
                       "`--robot` names this robot, and begin again",
                       misfit, extent);
  if (4 * result.used < 3 * whole)
    return fmt::format("the model fits only {} of {} legs; check that the floor is level and the "
                       "same everywhere, and begin again",
                       result.used, whole);
  return nonsense(result);
}

} // namespace

tl::expected<Calibration, Failure> fit(std::span<const Leg> legs, spec::Robot robot) {
  const auto model = spec::driving(robot);
  auto used = whole(legs);
  Calibration result;
  result.legs = legs.size();
  if (used.empty())
    return refuse(ExitCode::Refused, doubt(result, 0, 0, 0));
  const auto whole = used.size();
  // Speeds first: while they are far off, no other parameter can be determined.
  Vector at = lowest({&used, &model, speeds_only(pull_some)}, each(1));
  at = lowest({&used, &model, each(pull_weak)}, at);
  used = fitting(used, model, at);
  at = find(used, model, at, result);

  result.before = result.after = model;
  result.used = used.size();
  for (std::size_t row = 0; row < rows; ++row)
    set_value(result.after, driving_rows[row], value_at(driving_rows[row], model, at[index(row)]));
  result.error_before_cm = error_cm(used, model, each(1));
  result.error_after_cm = error_cm(used, model, at);
  const auto by_speed = [](const Leg* a, const Leg* b) { return top_speed(*a) < top_speed(*b); };
  const auto [slow, fast] = std::minmax_element(used.begin(), used.end(), by_speed);
  result.slowest = top_speed(**slow);
  result.fastest = top_speed(**fast);
  result.doubt = doubt(result, whole, steady_cm(residuals_of(used, model, at)), extent_cm(used));
  return result;
}

spec::Driving with_speeds_of(std::span<const Leg> legs, spec::Robot robot) {
  auto numbers = spec::driving(robot);
  const auto model = numbers;
  auto used = whole(legs);
  const auto search = [&] { return lowest({&used, &model, speeds_only(pull_some)}, each(1)); };
  auto at = search();
  if (const auto kept = fitting(used, model, at); kept.size() < used.size()) {
    used = kept;
    at = search();
  }
  for (std::size_t row = 0; row < rows; ++row)
    if (is_speed(driving_rows[row]))
      set_value(numbers, driving_rows[row], value_at(driving_rows[row], model, at[index(row)]));
  return numbers;
}

} // namespace orb::run
