// The compiled half of the Python package orb_robot: robots on bytes, in virtual time. Mistakes of
// callers raise Python exceptions whose message is a sentence.

#include "base/text/utf8.h"
#include "playground/engine/engine.h"
#include "protocol/describe.h"
#include "protocol/describe_v2.h"
#include "protocol/payload.h"
#include "protocol/payload_v2.h"
#include "report/page.h"
#include "report/svg.h"
#include "robot/robot.h"
#include "robot/words.h"
#include "spec/ble.h"
#include "spec/colours.h"
#include "vm/common/bluetooth.h"

#include <fmt/format.h>
#include <map>
#include <memory>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <string>
#include <tuple>
#include <vector>

namespace py = pybind11;
using namespace py::literals;

namespace orb::python {
namespace {

using robot::in_seconds;
using robot::Robot;
using robot::World;
using Rgb = std::tuple<int, int, int>;

Rgb rgb(const vm::Color& color) {
  return {color.red, color.green, color.blue};
}

template <class Value>
Value checked(tl::expected<Value, std::string> value) {
  if (!value)
    throw py::value_error(value.error());
  return *std::move(value);
}

/// Finds the row called `text`; the exception names a similar one, or all.
template <class Rows, class Find>
const auto& row_of(std::string_view text, std::string_view what, const Rows& rows, Find find) {
  if (const auto* row = find(text))
    return *row;
  std::vector<std::string_view> names;
  for (const auto& row : rows)
    names.push_back(row.name);
  throw py::value_error(robot::no_such(what, text, names));
}

robot::Options options_of(std::string name, std::uint64_t seed, double x, double y, double heading,
                          std::string firmware, std::string fault, bool journey) {
  return checked(
      robot::read_options({std::move(name), seed, x, y, heading, std::move(firmware),
                           std::move(fault), journey ? robot::Keep::Journey : robot::Keep::State}));
}

/// The bytes of any contiguous buffer, without a copy.
class BufferView {
public:
  explicit BufferView(const py::handle& object) {
    if (PyObject_GetBuffer(object.ptr(), &view_, PyBUF_SIMPLE) != 0)
      throw py::error_already_set();
  }
  ~BufferView() { PyBuffer_Release(&view_); }
  BufferView(const BufferView&) = delete;
  BufferView& operator=(const BufferView&) = delete;
  ByteView bytes() const {
    return {static_cast<const std::uint8_t*>(view_.buf), static_cast<std::size_t>(view_.len)};
  }

private:
  Py_buffer view_{};
};

py::bytes as_python(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

py::dict gatt(const std::string& kind) {
  const auto gatt = robot::gatt(checked(robot::read_kind(kind)));
  py::list characteristics;
  for (const auto& one : gatt.characteristics)
    characteristics.append(py::make_tuple(one.service, one.uuid,
                                          py::tuple(py::cast(robot::properties(one.can))),
                                          py::bytes(one.value.data(), one.value.size())));
  py::list greeting;
  for (const auto& one : gatt.greeting)
    greeting.append(py::make_tuple(one.uuid, py::bytes(one.bytes.data(), one.bytes.size())));
  return py::dict(
      "name_prefix"_a = gatt.name_prefix, "protocol"_a = gatt.protocol,
      "characteristics"_a = characteristics, "greeting"_a = greeting, "is_deaf"_a = gatt.is_deaf,
      "patience"_a = gatt.patience ? py::object(py::cast(gatt.patience->count())) : py::none(),
      "commands_uuid"_a = gatt.commands_uuid, "answers_uuid"_a = gatt.answers_uuid,
      "advertised_service"_a = gatt.advertised_service,
      "advertised_power"_a = gatt.advertised_power, "advertised_maker"_a = gatt.advertised_maker);
}

/// Constants of all links, in seconds and bytes.
py::dict radio() {
  constexpr double ms_per_s = 1000;
  return py::dict("interval"_a = spec::ble_interval_ms / ms_per_s,
                  "advertises_every"_a = spec::ble_advertises_ms / ms_per_s,
                  "turns_to_connect"_a = spec::ble_turns_to_connect,
                  "piece_bytes"_a = spec::ble_piece_bytes);
}

std::vector<std::string_view> kinds() {
  std::vector<std::string_view> names;
  for (const auto& row : spec::robots)
    names.push_back(row.name);
  return names;
}

py::object matrix(const robot::State& state) {
  if (!state.matrix)
    return py::none();
  std::vector<Rgb> pixels;
  for (const auto& color : *state.matrix)
    pixels.push_back(rgb(color));
  return py::cast(pixels);
}

auto path(const Robot& robot) {
  std::vector<std::tuple<double, double, double, double, double>> out;
  const auto journey = robot.journey();
  for (const auto& [t, pose] : journey.poses().entries())
    out.emplace_back(in_seconds(t), pose.x_cm, pose.y_cm, pose.heading_deg, pose.speed_cm_s);
  return out;
}

auto events(const Robot& robot) {
  std::vector<std::tuple<double, std::string_view, std::string>> out;
  for (const auto& one : robot.journey().listed().happenings)
    out.emplace_back(in_seconds(one.t), report::to_string(one.kind), one.text);
  return out;
}

/// Passes the journeys of all robots of a world to `draw`.
template <class Draw>
std::string drawn(const World& world, Draw draw) {
  std::vector<report::Journey> journeys;
  std::vector<report::RoomRun> runs;
  journeys.reserve(world.robots().size());
  for (const auto& robot : world.robots()) {
    journeys.push_back(robot->journey());
    runs.push_back({robot->options().name, &journeys.back()});
  }
  return draw(runs);
}

std::unique_ptr<Robot> make_robot(const std::string& kind, std::uint64_t seed, double x, double y,
                                  double heading, const std::string& firmware,
                                  const std::string& fault, const std::string& course,
                                  bool journey) {
  return std::make_unique<Robot>(checked(robot::read_kind(kind)),
                                 options_of("1", seed, x, y, heading, firmware, fault, journey),
                                 checked(robot::read_course(course)));
}

std::unique_ptr<Robot> fork_robot(const Robot& robot) {
  auto fork = robot.fork();
  if (!fork)
    throw py::value_error("the robot is in a world with others; fork the world");
  return fork;
}

// Packets in words.

/// Returns a sentence for each packet, and for bytes that are none.
template <class Decoder, class Describer>
std::vector<std::string> sentences(Decoder decoder, ByteView bytes) {
  std::vector<std::string> out;
  Describer describer;
  decoder.feed(bytes);
  while (const auto item = decoder.next())
    out.push_back(describer.describe(*item));
  return out;
}

std::vector<std::string> decode(const py::object& data, const std::string& direction) {
  const BufferView view(data);
  const auto bytes = view.bytes();
  if (direction != "to-robot" && direction != "from-robot")
    throw py::value_error(fmt::format(
        "there is no direction `{}`; write `to-robot` or `from-robot`", to_printable(direction)));
  if (!bytes.empty() && bytes.front() == spec::v2_start)
    return sentences<protocol::DecoderV2, protocol::DescriberV2>(protocol::DecoderV2{}, bytes);
  return sentences<protocol::Decoder, protocol::Describer>(
      protocol::Decoder{direction == "to-robot" ? protocol::Direction::ToBall
                                                : protocol::Direction::FromBall},
      bytes);
}

py::bytes encode_command(const std::string& name, const std::string& command,
                         const std::vector<std::string>& values, std::uint8_t seq) {
  const auto& kind = spec::info(checked(robot::read_kind(name)));
  if (kind.packets == spec::Packets::V2) {
    const auto& row = row_of(command, "command", spec::v2_commands,
                             [](std::string_view word) { return spec::find_v2_command(word); });
    const auto data = checked(protocol::encode_operands(row.command, values));
    return as_python(
        encode(protocol::address(protocol::make_request(row.command, data, seq), kind)));
  }
  const auto& row = row_of(command, "command", spec::api_commands,
                           [](std::string_view word) { return spec::find_command(word); });
  const auto data = protocol::encode_operands(row.command, values);
  if (!data)
    throw py::value_error(data.error().message);
  return as_python(encode(protocol::make_command(row.command, *data, seq)));
}

/// The English names of colours, with their values.
std::map<std::string, Rgb> colours() {
  std::map<std::string, Rgb> out;
  constexpr unsigned byte = 0xFF;
  for (const auto& row : spec::colours)
    if (!row.name.empty())
      out.emplace(row.name, Rgb{row.rgb >> 16U, row.rgb >> 8U & byte, row.rgb & byte});
  return out;
}

void bind_state(py::module_& module) {
  using robot::State;
  py::class_<State>(module, "State")
      .def_property_readonly("t", [](const State& s) { return in_seconds(s.t); })
      .def_property_readonly("x", [](const State& s) { return s.pose.x_cm; })
      .def_property_readonly("y", [](const State& s) { return s.pose.y_cm; })
      .def_property_readonly("heading", [](const State& s) { return s.pose.heading_deg; })
      .def_property_readonly("speed", [](const State& s) { return s.pose.speed_cm_s; })
      .def_property_readonly("rgb", [](const State& s) { return rgb(s.rgb); })
      .def_readonly("back_led", &State::back_led)
      .def_property_readonly("matrix", matrix)
      .def_readonly("volts", &State::volts)
      .def_readonly("charge", &State::charge)
      .def_readonly("way", &State::way_cm)
      .def_readonly("asleep", &State::asleep)
      .def_readonly("connected", &State::connected)
      .def_property_readonly("running",
                             [](const State& s) { return s.program_runs || s.macro_runs; })
      .def_readonly("driving", &State::drives)
      .def_readonly("collisions", &State::collisions)
      .def_readonly("bumps", &State::bumps);
}

void bind_course(py::module_& module) {
  using report::Course;
  const auto zone = [](const Course& course, const std::string& id) -> const report::Zone& {
    if (const auto* found = course.zone(id))
      return *found;
    throw py::value_error(fmt::format("the course has no zone `{}`", to_printable(id)));
  };
  py::class_<Course>(module, "Course")
      .def(py::init([](const std::string& text) { return checked(robot::read_course(text)); }),
           "drawing"_a)
      .def_property_readonly("zones",
                             [](const Course& course) {
                               py::dict out;
                               for (const auto& one : course.zones)
                                 out[py::str(one.id)] = py::make_tuple(
                                     one.box.low.x, one.box.low.y, one.box.high.x, one.box.high.y);
                               return out;
                             })
      .def(
          "distance",
          [zone](const Course& course, const std::string& id, double x, double y) {
            return zone(course, id).distance_cm({x, y});
          },
          "zone"_a, "x"_a, "y"_a);
}

void bind_robot(py::module_& module) {
  py::class_<Robot>(module, "Robot")
      .def(py::init(&make_robot), "kind"_a, py::kw_only(), "seed"_a = 1, "x"_a = 0.0, "y"_a = 0.0,
           "heading"_a = 0.0, "firmware"_a = "", "fault"_a = "", "course"_a = "",
           "journey"_a = true)
      .def_property_readonly("kind", [](const Robot& r) { return r.kind().name; })
      .def_property_readonly("title", [](const Robot& r) { return r.kind().title; })
      .def_property_readonly(
          "name", [](const Robot& r) { return vm::advertised_name(r.kind().ble, r.address()); })
      .def_property_readonly("address", [](const Robot& r) { return vm::with_colons(r.address()); })
      .def_property_readonly("connected", &Robot::connected)
      .def_property_readonly("asleep", [](const Robot& r) { return r.state().asleep; })
      .def_property_readonly("now", [](const Robot& r) { return in_seconds(r.now()); })
      .def("connect", &Robot::connect)
      .def("disconnect", &Robot::disconnect)
      .def(
          "write", [](Robot& r, const py::object& data) { r.write(BufferView(data).bytes()); },
          "data"_a)
      .def("read", [](Robot& r) { return as_python(r.read()); })
      .def(
          "advance",
          [](Robot& r, double time_s) { r.advance(checked(robot::read_seconds(time_s))); },
          "seconds"_a)
      .def("next_event",
           [](const Robot& r) {
             const auto next = r.next_event();
             return next ? std::optional(in_seconds(*next)) : std::nullopt;
           })
      .def("state", &Robot::state)
      .def(
          "stimulus",
          [](Robot& r, const std::string& line) {
            if (const auto done = r.stimulus(line); !done)
              throw py::value_error(done.error());
          },
          "line"_a)
      .def("path", &path)
      .def("events", &events)
      .def("reset", &Robot::reset)
      .def("fork", &fork_robot)
      .def(
          "report",
          [](const Robot& r, const std::string& title) {
            return report::report_page(r.journey(), title);
          },
          "title"_a = "robot")
      .def("svg", [](const Robot& r) { return report::path_svg(r.journey()); });
}

void bind_world(py::module_& module) {
  py::class_<World>(module, "World")
      .def(py::init([](const std::string& course) {
             return std::make_unique<World>(checked(robot::read_course(course)));
           }),
           "course"_a = "")
      .def(
          "add",
          [](World& w, const std::string& kind, std::string name, std::uint64_t seed, double x,
             double y, double heading, const std::string& firmware, const std::string& fault,
             bool journey) {
            return checked(
                w.add(checked(robot::read_kind(kind)),
                      options_of(std::move(name), seed, x, y, heading, firmware, fault, journey)));
          },
          py::return_value_policy::reference_internal, "kind"_a, py::kw_only(), "name"_a = "",
          "seed"_a = 1, "x"_a = 0.0, "y"_a = 0.0, "heading"_a = 0.0, "firmware"_a = "",
          "fault"_a = "", "journey"_a = true)
      .def_property_readonly(
          "robots",
          [](const py::object& self) {
            py::list out;
            for (const auto& robot : self.cast<const World&>().robots())
              out.append(py::cast(robot.get(), py::return_value_policy::reference_internal, self));
            return out;
          })
      .def_property_readonly("now", [](const World& w) { return in_seconds(w.now()); })
      .def(
          "advance",
          [](World& w, double time_s) { w.advance(checked(robot::read_seconds(time_s))); },
          "seconds"_a)
      .def("reset", &World::reset)
      .def("fork", &World::fork)
      .def(
          "report",
          [](const World& w, const std::string& title) {
            return drawn(w, [&](const auto& runs) { return report::room_page(runs, title); });
          },
          "title"_a = "robots")
      .def("svg", [](const World& w) {
        return drawn(w, [](const auto& runs) { return report::room_svg(runs); });
      });
}

} // namespace

PYBIND11_MODULE(_orb, module) {
  module.doc() = "Virtual Sphero robots on bytes, in virtual time; use it through orb_robot.";
  module.attr("__version__") = ORB_VERSION;
  module.def("kinds", &kinds, "The names of all robots.");
  module.def("gatt", &gatt, "kind"_a, "How a kind of robot speaks over Bluetooth LE.");
  module.def("radio", &radio, "What holds for every link over Bluetooth LE.");
  module.def("decode", &decode, "data"_a, "direction"_a);
  module.def("encode", &encode_command, "kind"_a, "command"_a, "values"_a, "seq"_a);
  module.def("colours", &colours, "The colours that have names, as red, green and blue.");
  py::class_<playground::Engine>(module, "Engine")
      .def(py::init<>())
      .def("call", [](playground::Engine& engine, const std::string& request) {
        return engine.answer(request.c_str());
      });
  bind_course(module);
  bind_state(module);
  bind_robot(module);
  bind_world(module);
}

} // namespace orb::python
