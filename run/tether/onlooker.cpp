#include "run/tether/onlooker.h"

#include "protocol/packet.h"
#include "protocol/payload.h"
#include "spec/api.h"

namespace orb::run {
namespace {

using protocol::Async;
using spec::AsyncId;

bool has_id(const Async& message, AsyncId id) {
  return message.id == static_cast<std::uint8_t>(id);
}

vm::BallOptions options_for(vm::Observer& observer) {
  vm::BallOptions options;
  options.observer = &observer;
  return options;
}

} // namespace

Onlooker::Onlooker(report::Journey& journey)
    : journey_(journey), wire_(make_wire(spec::Robot::Sphero)), ball_(options_for(*this)) {
  ball_.become(*this);
  ball_.connect(); // keeps it from blinking and falling asleep
}

void Onlooker::on_event(Instant at, const vm::Event& event) {
  if (std::holds_alternative<vm::event::Led>(event)) // of this ball, not of the real one
    return;
  journey_.add(at.time_since_epoch(), event);
  journey_.sample(at.time_since_epoch(), ball_.body());
}

void Onlooker::feel(Duration t, const RobotMessage& said) {
  ball_.advance_to(std::max(ball_.now(), Instant{} + t));
  if (const auto* sample = std::get_if<vm::Sample>(&said.what))
    ball_.feel(*sample);
  else if (const auto* collision = std::get_if<vm::event::Collision>(&said.what))
    ball_.feel(*collision);
}

void Onlooker::hear(Duration t, const Async& message) {
  if (has_id(message, AsyncId::BasicPrint)) {
    journey_.add(t, vm::event::Print{std::string(as_text(message.data))});
  } else if (has_id(message, AsyncId::BasicError)) {
    const auto fields = protocol::read_fields(spec::fields(AsyncId::BasicError), message.data);
    const auto code = fields.size() == 2
                          ? spec::find_error(static_cast<std::uint16_t>(fields[1].number))
                          : std::nullopt;
    if (code)
      journey_.add(t, vm::event::Error{static_cast<int>(fields[0].number), *code});
  } else {
    const auto packet = encode(message);
    wire_->feed(packet);
    while (const auto said = wire_->next())
      feel(t, *said);
  }
}

} // namespace orb::run
