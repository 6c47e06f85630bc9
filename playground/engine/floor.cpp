#include "playground/engine/floor.h"

#include "playground/engine/reins.h"
#include "report/page.h"
#include "report/svg.h"
#include "robot/words.h"
#include "spec/ble.h"
#include "vm/common/bluetooth.h"

#include <fmt/format.h>
#include <utility>

namespace orb::playground {
namespace {

tl::unexpected<Problem> refuse_words(std::string sentence) {
  return refuse(ExitCode::Usage, std::move(sentence));
}

ordered_json rgb_json(const vm::Color& color) {
  return {color.red, color.green, color.blue};
}

ordered_json matrix(const robot::State& state) {
  if (!state.matrix)
    return nullptr;
  auto pixels = ordered_json::array();
  for (const auto& color : *state.matrix)
    pixels.push_back(rgb_json(color));
  return pixels;
}

ordered_json gatt_json(spec::Robot kind) {
  const auto gatt = robot::gatt(kind);
  auto characteristics = ordered_json::array();
  for (const auto& one : gatt.characteristics)
    characteristics.push_back({one.service, one.uuid, one.summary, robot::properties(one.can),
                               bytes_json(as_bytes(one.value))});
  auto greeting = ordered_json::array();
  for (const auto& one : gatt.greeting)
    greeting.push_back({one.uuid, bytes_json(as_bytes(one.bytes))});
  return {{"protocol", gatt.protocol},
          {"characteristics", characteristics},
          {"greeting", greeting},
          {"is_deaf", gatt.is_deaf},
          {"patience", gatt.patience ? ordered_json(gatt.patience->count()) : ordered_json()},
          {"commands_uuid", gatt.commands_uuid},
          {"answers_uuid", gatt.answers_uuid},
          {"advertised_service", gatt.advertised_service},
          {"piece_bytes", spec::ble_piece_bytes}};
}

} // namespace

tl::expected<robot::Robot*, Problem> Floor::find(Request& request) {
  const auto number = request.value<int>("robot").value_or(0);
  const auto found = robots_.find(number);
  if (found == robots_.end())
    return refuse_words(fmt::format("there is no robot {}, or it has been closed", number));
  return found->second;
}

Answer Floor::tell(int number) const {
  const auto& robot = *robots_.at(number);
  return print({{"robot", number},
                {"kind", robot.kind().name},
                {"title", robot.kind().title},
                {"name", vm::advertised_name(robot.kind().ble, robot.address())},
                {"address", vm::with_colons(robot.address())},
                {"gatt", gatt_json(robot.kind().robot)}});
}

Answer Floor::keep(std::unique_ptr<robot::Robot> robot) {
  auto& kept = alone_[++last_];
  kept = std::move(robot);
  robots_[last_] = kept.get();
  return tell(last_);
}

Answer Floor::add_world(Request& request) {
  auto course = robot::read_course(request.text("course"));
  if (!course)
    return refuse_words(course.error());
  worlds_[++last_] = std::make_unique<robot::World>(*std::move(course));
  return print({{"world", last_}});
}

Answer Floor::add_robot(Request& request) {
  const auto advertised = request.value<std::string>("advertised");
  const auto kind =
      advertised ? robot_named(*advertised) : robot::read_kind(request.text("kind", "bolt"));
  if (!kind)
    return refuse_words(kind.error());
  const auto number = [&](const char* key) { return request.value<double>(key).value_or(0); };
  const auto options = robot::read_options(
      {request.text("name"), request.value<std::uint64_t>("seed").value_or(1), number("x"),
       number("y"), number("heading"), request.text("firmware"), request.text("fault"),
       request.flag("journey", true) ? robot::Keep::Journey : robot::Keep::State});
  if (!options)
    return refuse_words(options.error());
  if (const auto world = request.value<int>("world")) {
    const auto found = worlds_.find(*world);
    if (found == worlds_.end())
      return refuse_words(fmt::format("there is no world {}, or it has been closed", *world));
    const auto added = found->second->add(*kind, *options);
    if (!added)
      return refuse_words(added.error());
    robots_[++last_] = *added;
    return tell(last_);
  }
  auto course = robot::read_course(request.text("course"));
  if (!course)
    return refuse_words(course.error());
  return keep(std::make_unique<robot::Robot>(*kind, *options, *std::move(course)));
}

Answer Floor::fork(Request& request) {
  const auto robot = find(request);
  if (!robot)
    return tl::unexpected(robot.error());
  auto fork = (*robot)->fork();
  if (!fork)
    return refuse_words(
        "the robot is in a world with others; only one that is alone can be forked");
  return keep(std::move(fork));
}

Answer link_robot(robot::Robot& robot, Request& request) {
  if (request.flag("connected"))
    robot.connect();
  else
    robot.disconnect();
  return print({{"connected", robot.connected()}});
}

Answer step_robot(robot::Robot& robot, Request& request) {
  const auto time = robot::read_seconds(request.value<double>("advance").value_or(0));
  if (!time)
    return refuse_words(time.error());
  if (const auto bytes = request.params.find("write"); bytes != request.params.end())
    robot.write(bytes_of(*bytes));
  if (*time > Duration{})
    robot.advance(*time);
  const auto next = robot.next_event();
  return print({{"bytes", bytes_json(robot.read())},
                {"now", robot::in_seconds(robot.now())},
                {"next", next ? ordered_json(robot::in_seconds(*next)) : ordered_json()},
                {"connected", robot.connected()}});
}

Answer state_of_robot(robot::Robot& robot, Request&) {
  const auto state = robot.state();
  return print({{"t", robot::in_seconds(state.t)},
                {"x", state.pose.x_cm},
                {"y", state.pose.y_cm},
                {"heading", state.pose.heading_deg},
                {"speed", state.pose.speed_cm_s},
                {"rgb", rgb_json(state.rgb)},
                {"back_led", state.back_led},
                {"matrix", matrix(state)},
                {"volts", state.volts},
                {"charge", state.charge},
                {"way", state.way_cm},
                {"asleep", state.asleep},
                {"connected", state.connected},
                {"running", state.program_runs || state.macro_runs},
                {"driving", state.drives},
                {"collisions", state.collisions},
                {"bumps", state.bumps}});
}

Answer stimulate_robot(robot::Robot& robot, Request& request) {
  if (const auto done = robot.stimulus(request.text("line")); !done)
    return refuse_words(done.error());
  return std::string("{}");
}

Answer reset_robot(robot::Robot& robot, Request&) {
  robot.reset();
  return std::string("{}");
}

Answer journey_of_robot(robot::Robot& robot, Request& request) {
  const auto journey = robot.journey();
  return fmt::format(R"({{"svg":{},"report":{}}})", print(report::path_svg(journey)),
                     report::run_json(journey, request.text("title", robot.kind().title)));
}

/// A robot in a world is deleted with the world.
Answer Floor::end(Request& request) {
  if (const auto world = request.value<int>("world")) {
    if (const auto found = worlds_.find(*world); found != worlds_.end()) {
      for (const auto& robot : found->second->robots())
        std::erase_if(robots_, [&](const auto& one) { return one.second == robot.get(); });
      worlds_.erase(found);
    }
    return std::string("{}");
  }
  const auto number = request.value<int>("robot").value_or(0);
  if (alone_.erase(number) != 0)
    robots_.erase(number);
  return std::string("{}");
}

} // namespace orb::playground
