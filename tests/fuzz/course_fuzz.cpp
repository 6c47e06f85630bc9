// Reads any text as a course, queries its zones and drives a ball among its walls.

#include "report/course.h"
#include "vm/ball.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orb;
  const Source source("fuzz.svg", std::string(as_text({data, size})));
  const auto reading = report::read_course(source);
  for (const auto& finding : reading.findings)
    if (finding.span.begin > finding.span.end || finding.span.end > size)
      __builtin_trap();
  for (const auto& zone : reading.course.zones)
    if (zone.contains({1, 1}) && zone.distance_cm({1, 1}) != 0)
      __builtin_trap();
  if (reading.course.walls.size() > 100) // the ball would take too long
    return 0;
  vm::Ball ball({});
  ball.schedule(reading.course.stimuli());
  ball.drive(vm::Roll{30, 200, vm::Go::Drive});
  ball.advance_to(ball.now() + 300ms);
  const auto pose = ball.body().pose();
  if (!(pose.x_cm * pose.x_cm + pose.y_cm * pose.y_cm < 1e6))
    __builtin_trap();
  return 0;
}
