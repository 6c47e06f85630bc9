#include "testing/check_room.h"

#include "run/room.h"
#include "testing/check_javascript.h"
#include "testing/text/rules.h"
#include "testing/texts.h"

namespace orb::testing {

void check_room(SuiteFile& file, structured::Files& files) {
  auto& findings = file.file.diagnostics;
  const auto& balls = file.file.balls;
  if (!balls.empty() && file.file.program)
    findings.push_back(finding(rules::Place, file.file.program->span, texts::ProgramBesideBalls(),
                               texts::OmitProgramOrBalls()));
  std::vector<run::RoomBall> placed;
  for (const auto& ball : balls) {
    auto& one = placed.emplace_back();
    one.name = ball.name.text;
    one.options.start = ball.start;
    one.options.course = file.course.get();
    if (is_javascript(ball.program.text))
      refuse_in_room(file, ball);
    if (&ball != &balls.front()) // program_path() reports the first ball
      if (const auto path = structured::resolve_path(file.source->name(), ball.program.text);
          !files.read(path))
        findings.push_back(finding(rules::File, ball.program.span, texts::CannotRead(path),
                                   texts::FromFolderOfTest()));
  }
  for (const auto& clash : run::clashes(placed))
    findings.push_back(finding(
        rules::Value, balls[clash.ball].name.span,
        clash.other ? texts::StartsInside(placed[clash.ball].name, placed[*clash.other].name)
                    : texts::StartsInWall(placed[clash.ball].name, vm::to_string(*clash.wall)),
        texts::OtherPlace()));
}

} // namespace orb::testing
