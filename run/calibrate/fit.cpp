#include "run/calibrate/fit.h"

#include "base/refuse.h"
#include "vm/body/angles.h"
#include "vm/body/body.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>
#include <vector>

namespace orb::run {
namespace {

constexpr std::size_t rows = driving_rows.size();
/// Each number as how many times the model's it is.
using Vector = Eigen::VectorXd;
using Residuals = std::vector<double>;

Vector as_the_model() {
  return Vector::Ones(static_cast<Eigen::Index>(rows));
}

constexpr double yaw_cm_per_deg = 0.2; ///< what a degree counts beside places
constexpr double furthest = 3;         ///< times the model's number, or a third of it
constexpr double open_share = 0.15;    ///< a greater spread leaves a number open
constexpr double misfit_share = 0.5;   ///< of the error before, left after
constexpr double misfit_cm = 4;

/// Where the model is when the robot was seen.
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

/// The instant from which on a leg counts: it has turned on the spot, and still rests.
Duration counts_from(const Leg& leg) {
  constexpr Duration before = 150ms;
  return leg.orders[1].at - before;
}

/// What the model is off by, in cm. Where a leg began nobody knows better than all that was seen of
/// it, so the mean of its places is taken off.
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

/// Its dead time lies between two steps of the control system, and so do the residuals. An order
/// that is followed comes right after a step; a real one comes half a step later on average.
Residuals residuals_of(const std::vector<const Leg*>& legs, const spec::Driving& model,
                       const Vector& at) {
  spec::Driving numbers;
  numbers = model;
  double steps = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const double times = std::clamp(at[static_cast<Eigen::Index>(row)], 1 / furthest, furthest);
    if (driving_rows[row].place == nullptr)
      steps = std::clamp(model.dead_steps * times - 0.5, 0.0, spec::most_dead_steps - 1.0);
    else
      set_value(numbers, driving_rows[row], value_of(model, driving_rows[row]) * times);
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

/// The residuals as Eigen asks for them.
struct Misfit {
  using Scalar = double;
  using InputType = Vector;
  using ValueType = Vector;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  int inputs() const { return static_cast<int>(rows); }
  int values() const { return count; }
  int operator()(const Vector& at, Vector& out) const {
    const auto residuals = residuals_of(*legs, *model, at);
    out = Eigen::Map<const Vector>(residuals.data(), static_cast<Eigen::Index>(residuals.size()));
    return 0;
  }

  const std::vector<const Leg*>* legs;
  const spec::Driving* model;
  int count;
};

struct Found {
  Vector at = as_the_model();
  Vector spread; ///< as parts of the model's numbers
};

Found lowest(const std::vector<const Leg*>& legs, const spec::Driving& model) {
  constexpr double step = 0.02; // of a number: the physics goes in steps, less would be noise
  Found found;
  const auto count = residuals_of(legs, model, found.at).size();
  using Differences = Eigen::NumericalDiff<Misfit, Eigen::Central>;
  Differences misfit(Misfit{&legs, &model, static_cast<int>(count)}, step * step);
  Eigen::LevenbergMarquardt<Differences> search(misfit);
  constexpr double close = 1e-5;
  search.parameters.ftol = close;
  search.parameters.xtol = close;
  search.parameters.maxfev = 400;
  search.minimize(found.at);

  Eigen::MatrixXd slopes(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(rows));
  Vector residuals;
  misfit.df(found.at, slopes);
  misfit(found.at, residuals);
  const double one =
      residuals.squaredNorm() / static_cast<double>(std::max(count, rows + 1) - rows);
  const Eigen::MatrixXd curve = slopes.transpose() * slopes;
  found.spread = (curve.completeOrthogonalDecomposition().pseudoInverse().diagonal() * one)
                     .cwiseAbs()
                     .cwiseSqrt();
  return found;
}

/// What the places of the legs are off by, root mean square.
double error_cm(const std::vector<const Leg*>& legs, const spec::Driving& model, const Vector& at) {
  const auto residuals = residuals_of(legs, model, at);
  double sum = 0;
  for (std::size_t i = 0; i + 2 < residuals.size(); i += 3)
    sum += residuals[i] * residuals[i] + residuals[i + 1] * residuals[i + 1];
  return residuals.empty() ? 0 : std::sqrt(sum * 3 / static_cast<double>(residuals.size()));
}

/// Those that the numbers found do not fit much worse than the others: an order may be lost.
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

tl::expected<void, Failure> believable(const Calibration& result, const Found& found) {
  for (std::size_t row = 0; row < rows; ++row) {
    const auto& info = driving_rows[row];
    const auto at = static_cast<Eigen::Index>(row);
    if (found.at[at] > 0.99 * furthest || found.at[at] * furthest < 1 / 0.99)
      return refuse(
          ExitCode::Refused,
          fmt::format("`{}` differs by a factor of more than {} from the model's {}: check that "
                      "`--robot` names this robot, and that nothing is holding it back",
                      info.name, furthest, value_of(result.before, info)));
    if (found.spread[at] > open_share * found.at[at])
      return refuse(ExitCode::Refused,
                    fmt::format("this drive is not enough to determine `{}`: {:.3g} ± {:.2g}; "
                                "begin again on a level floor",
                                info.name, value_of(result.after, info), result.spread[row]));
  }
  if (result.error_after_cm > misfit_cm &&
      result.error_after_cm > misfit_share * result.error_before_cm)
    return refuse(
        ExitCode::Refused,
        fmt::format(
            "the model does not fit this robot: position error {:.1f} cm before, {:.1f} cm after",
            result.error_before_cm, result.error_after_cm));
  return {};
}

} // namespace

tl::expected<Calibration, Failure> fit(std::span<const Leg> legs, spec::Robot robot) {
  const auto model = spec::driving(robot);
  std::vector<const Leg*> used;
  for (const auto& leg : legs)
    if (!leg.broken)
      used.push_back(&leg);
  const auto enough = [&] { return 4 * used.size() >= 3 * legs.size() && !used.empty(); };
  const auto too_few = [&] {
    return refuse(ExitCode::Refused, fmt::format("only {} of {} legs are usable; the link lost the "
                                                 "others; move closer to the robot and try again",
                                                 used.size(), legs.size()));
  };
  if (!enough())
    return too_few();
  auto found = lowest(used, model);
  if (const auto kept = fitting(used, model, found.at); kept.size() < used.size()) {
    used = kept;
    if (!enough())
      return too_few();
    found = lowest(used, model);
  }
  Calibration result;
  result.before = result.after = model;
  result.legs = legs.size();
  result.used = used.size();
  for (std::size_t row = 0; row < rows; ++row) {
    const double value = value_of(model, driving_rows[row]);
    const auto at = static_cast<Eigen::Index>(row);
    set_value(result.after, driving_rows[row], value * found.at[at]);
    result.spread[row] = value * found.spread[at];
  }
  result.error_before_cm = error_cm(used, model, as_the_model());
  result.error_after_cm = error_cm(used, model, found.at);
  if (auto good = believable(result, found); !good)
    return tl::unexpected(good.error());
  return result;
}

} // namespace orb::run
