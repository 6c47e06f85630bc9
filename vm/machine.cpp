#include "vm/machine.h"

namespace orb::vm {

Machine::Machine(std::uint32_t, std::uint64_t) {}
void Machine::start(bytecode::Chunk, int, Instant) {}
void Machine::run(Instant, Host&) {}
Instant Machine::next_event() const {
  return never;
}
void Machine::abort(Instant) {}
void Machine::stop(event::End::Reason) {}
void Machine::deliver_input(std::int32_t, Instant) {}
std::optional<Machine::Stop> Machine::take_stop() {
  return stop_;
}
std::int32_t Machine::variable(std::size_t) const {
  return 0;
}

} // namespace orb::vm
