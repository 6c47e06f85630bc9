#include "cli/commands/robot/watch_newer.h"

#include "cli/context/json.h"
#include "run/tether/wire.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace orb::cli {
namespace {

using protocol::LinkError;

constexpr Duration between_samples = 1s; ///< between printed samples
constexpr Duration between_batteries = 10s;

/// Prints messages by name and fields.
class Print {
public:
  explicit Print(std::string_view format) : json_(format == "json") {}

  void sample(const vm::Sample& s) const {
    const double speed = std::hypot(s.velocity_cm_s.x, s.velocity_cm_s.y);
    if (json_)
      return message("sensors", {{"x", rounded(s.place_cm.x)},
                                 {"y", rounded(s.place_cm.y)},
                                 {"speed", rounded(speed)},
                                 {"yaw", rounded(s.yaw_deg)},
                                 {"pitch", rounded(s.pitch_deg)},
                                 {"roll", rounded(s.roll_deg)}});
    print_out(fmt::format("sensors: x {:.0f} cm, y {:.0f} cm, speed {:.0f} cm/s, yaw {:.0f}°, "
                          "pitch {:.0f}°, roll {:.0f}°\n",
                          whole(s.place_cm.x), whole(s.place_cm.y), whole(speed), whole(s.yaw_deg),
                          whole(s.pitch_deg), whole(s.roll_deg)));
  }
  void collision(const vm::event::Collision& c) const {
    if (json_)
      return message("collision", {{"x", c.x},
                                   {"y", c.y},
                                   {"axis", c.axis},
                                   {"xmag", c.x_magnitude},
                                   {"ymag", c.y_magnitude},
                                   {"speed", c.speed}});
    print_out(fmt::format("collision: x {}, y {}, axis {}, xmag {}, ymag {}, speed {}\n", c.x, c.y,
                          c.axis, c.x_magnitude, c.y_magnitude, c.speed));
  }
  void battery(const vm::stimulus::Battery& b) const {
    if (json_)
      return message("battery", {{"volts", b.volts}});
    print_out(fmt::format("battery: {:.2f} V\n", b.volts));
  }

private:
  static double rounded(double value) { return std::round(value * 10) / 10 + 0.0; }
  /// Avoids `-0`.
  static double whole(double value) { return std::round(value) + 0.0; }
  static void message(std::string_view name, Json fields) {
    print_json({{"kind", "message"}, {"name", name}, {"fields", std::move(fields)}});
  }

  bool json_;
};

class Watch {
public:
  Watch(protocol::Transport& link, spec::Robot robot, Print print)
      : link_(link), wire_(run::make_wire(robot)), print_(print) {}

  tl::expected<void, Failure> begin() {
    auto asked = ask_all({request(spec::V2Command::Wake)});
    if (asked)
      asked = detect_collisions();
    return asked ? ask_all(wire_->stream({})) : asked;
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  /// Ends the streams, even if nobody reads any more.
  ~Watch() {
    static_cast<void>(ask_all(wire_->silence())); // the link may be gone
    static_cast<void>(ask_all(collisions(wire_->teardown())));
  }
  tl::expected<void, Failure> listen(Duration lasts) {
    const auto until = lasts == Duration{} ? never : now() + lasts;
    while (now() < until) {
      if (now() >= battery_at_)
        if (auto asked = ask_battery(); !asked)
          return asked;
      if (auto heard = hear(std::min({until, battery_at_, now() + 1s})); !heard)
        return heard;
    }
    return {};
  }

private:
  Instant now() const { return link_.now(); }

  static run::Request request(spec::V2Command command) {
    const auto& row = spec::info(command);
    return {row.did(), row.cid(), {}, run::Request::Need::Must};
  }
  /// Selects the preparations for a run that enable collision messages; none of them moves the
  /// robot.
  static std::vector<run::Request> collisions(std::vector<run::Request> all) {
    const auto& row = spec::info(spec::V2Command::CollisionDetection);
    std::erase_if(
        all, [&](const run::Request& one) { return one.did != row.did() || one.cid != row.cid(); });
    return all;
  }

  tl::expected<void, Failure> ask_all(const std::vector<run::Request>& requests) {
    for (const auto& one : requests)
      if (auto answer = ask(one); !answer)
        return tl::unexpected(answer.error());
    return {};
  }

  /// Enables collision messages with the command that the robot has.
  tl::expected<void, Failure> detect_collisions() {
    for (const auto& one : collisions(wire_->setup(run::Aim::Keep))) {
      const auto answer = ask(one);
      if (!answer)
        return tl::unexpected(answer.error());
      wire_->hear_setup(one, *answer);
    }
    return ask_all(wire_->setup_more());
  }

  tl::expected<void, Failure> ask_battery() {
    battery_at_ = now() + between_batteries;
    auto request = wire_->ask_battery();
    request.need = run::Request::Need::Try; // it may be busy: repeat the request
    const auto answer = ask(request);
    if (!answer)
      return tl::unexpected(answer.error());
    const auto battery = wire_->read_battery(answer->value_or(Bytes{}));
    if (battery && battery->volts != volts_) {
      volts_ = battery->volts;
      print_.battery(*battery);
    }
    return {};
  }

  /// Repeats a request until it is answered; refusing an optional one is not a failure.
  tl::expected<std::optional<Bytes>, Failure> ask(const run::Request& request) {
    constexpr int attempts = 3;
    constexpr Duration patience = 700ms;
    for (int attempt = 0; attempt < attempts; ++attempt) {
      const auto seq = std::exchange(seq_, wire_->next_seq(seq_));
      if (const auto sent = link_.write(wire_->encode(request, seq)); !sent)
        return tl::unexpected(lost(sent.error()));
      answer_.reset();
      for (const auto until = now() + patience; now() < until;) {
        if (auto heard = hear(until); !heard)
          return tl::unexpected(heard.error());
        if (!answer_ || answer_->seq != seq)
          continue;
        if (answer_->error == 0)
          return std::optional(answer_->data);
        if (request.need == run::Request::Need::Try)
          return std::nullopt;
        return tl::unexpected(Failure{
            ExitCode::Refused, fmt::format("the robot refuses {}: {}", wire_->name_of(request),
                                           wire_->describe(answer_->error))});
      }
    }
    return tl::unexpected(
        Failure{ExitCode::LinkLost, fmt::format("the robot does not answer {}; wake it, bring it "
                                                "closer, or run `orb doctor`",
                                                wire_->name_of(request))});
  }

  tl::expected<void, Failure> hear(Instant until) {
    const auto bytes = link_.read(until);
    if (!bytes)
      return tl::unexpected(lost(bytes.error()));
    wire_->feed(*bytes);
    while (const auto said = wire_->next()) {
      if (const auto* answer = std::get_if<run::RobotMessage::Answer>(&said->what))
        answer_ = *answer;
      else if (const auto* collision = std::get_if<vm::event::Collision>(&said->what))
        print_.collision(*collision);
      else if (const auto* sample = std::get_if<vm::Sample>(&said->what);
               sample != nullptr && now() >= sample_at_) {
        sample_at_ = now() + between_samples;
        print_.sample(*sample);
      }
    }
    return {};
  }

  static Failure lost(const LinkError& error) {
    if (error.kind == LinkError::Kind::Interrupted || error.kind == LinkError::Kind::Ended)
      return {ExitCode::Interrupted, "interrupted"};
    return {ExitCode::LinkLost, error.message};
  }

  protocol::Transport& link_;
  std::unique_ptr<run::RobotWire> wire_;
  Print print_;
  std::optional<run::RobotMessage::Answer> answer_; ///< the latest answer
  std::uint8_t seq_ = 0;
  Instant sample_at_{}; ///< when the next sample is printed
  Instant battery_at_{};
  double volts_ = 0;
};

} // namespace

tl::expected<void, Failure> watch_newer(const Context& context, Link& link, const Newer& newer,
                                        Duration lasts, std::string_view format) {
  Watch watch(*link.transport, newer.robot.robot, Print(format));
  auto begun = watch.begin();
  if (begun) {
    print_note(context, lasts == Duration{} ? "listening; Ctrl-C to stop" : "listening");
    constexpr Duration of_sim = 1s; // the virtual robot does not move, and its time costs nothing
    begun = watch.listen(link.is_sim && lasts == Duration{} ? of_sim : lasts);
    if (!begun && begun.error().code == ExitCode::Interrupted)
      begun = {}; // this is the normal end
  }
  return begun;
}

} // namespace orb::cli
