#include "vm/dispatcher.h"

namespace orb::vm {

void Dispatcher::receive(ByteView, Ball&) {}
void Dispatcher::run(Instant, Ball&) {}
void Dispatcher::on_disconnect(Ball&) {}
void Dispatcher::on_sleep(Ball&) {}
void Dispatcher::on_battery(Ball&) {}
void Dispatcher::on_collision(Ball&) {}

} // namespace orb::vm
