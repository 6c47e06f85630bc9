#include "run/tether/hold_robot.h"

#include "run/tether/driven.h"

#include <algorithm>

namespace orb::run {
namespace {

class TetheredRobot final : public HeldRobot {
public:
  TetheredRobot(protocol::Transport& transport, const TetherOptions& options)
      : options_(options), robot_(transport, options.robot, options.budgets, {}, options.reopen) {}

  tl::expected<void, Failure> begin() {
    auto first = robot_.begin(options_.aim);
    if (!first)
      return tl::unexpected(first.error());
    first_ = *first;
    return hold();
  }

  void obey(const vm::Motion& motion) override { robot_.obey(motion); }
  void show(vm::Color color) override { robot_.show(color); }
  void show_back(int level) override { robot_.show_back(level); }

  spec::Robot kind() const override { return options_.robot; }
  const vm::Sample& first() const override { return first_; }
  Duration time() const override { return robot_.is_stale() ? paused_at_ : elapsed(); }

  tl::expected<void, Failure> go_on(Duration t) override {
    auto goes = robot_.go_on();
    origin_ = robot_.program_now() - t;
    return goes;
  }
  tl::expected<void, Failure> hold() override { return robot_.hold(); }

  tl::expected<std::vector<Felt>, Failure> hear(Duration until) override {
    const bool was_stale = robot_.is_stale();
    std::vector<Felt> felt;
    const auto nap =
        was_stale ? longest_nap : std::clamp<Duration>(until - elapsed(), 1ms, longest_nap);
    if (auto pumped = robot_.pump(
            robot_.now() + nap,
            [&](const RobotMessage& said) {
              if (const auto* sample = std::get_if<vm::Sample>(&said.what))
                felt.emplace_back(*sample);
              else if (const auto* collision = std::get_if<vm::event::Collision>(&said.what))
                felt.emplace_back(*collision);
              else if (const auto* battery = std::get_if<vm::stimulus::Battery>(&said.what))
                felt.emplace_back(*battery);
            });
        !pumped)
      return tl::unexpected(pumped.error());
    watch(was_stale);
    return felt;
  }

private:
  Duration elapsed() const { return robot_.program_now() - origin_; }

  /// Stops the run's time while samples are missing.
  void watch(bool was_stale) {
    if (robot_.is_stale() == was_stale)
      return;
    if (was_stale)
      origin_ = robot_.program_now() - paused_at_;
    else
      paused_at_ = elapsed();
    if (options_.note)
      options_.note(std::string(was_stale ? samples_back : samples_gone));
  }

  const TetherOptions options_;
  Tether robot_;
  vm::Sample first_;
  Instant origin_{};
  Duration paused_at_{};
};

} // namespace

tl::expected<std::unique_ptr<HeldRobot>, Failure> hold_robot(protocol::Transport& transport,
                                                             const TetherOptions& tether) {
  auto held = std::make_unique<TetheredRobot>(transport, tether);
  if (auto begun = held->begin(); !begun)
    return tl::unexpected(begun.error());
  return held;
}

} // namespace orb::run
