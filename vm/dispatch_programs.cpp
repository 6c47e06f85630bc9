// Device 02h: macros and orbBasic.

#include "vm/dispatch.h"

namespace orb::vm {
namespace {

using spec::ResponseCode;

ResponseCode code(Outcome outcome) {
  switch (outcome) {
  case Outcome::Done: return ResponseCode::Ok;
  case Outcome::Refused: return ResponseCode::ExecuteFailed;
  }
  return ResponseCode::General;
}

ResponseCode code(MacroOutcome outcome) {
  switch (outcome) {
  case MacroOutcome::Done: return ResponseCode::Ok;
  case MacroOutcome::BadParameter: return ResponseCode::BadParameter;
  case MacroOutcome::CannotExecute: return ResponseCode::ExecuteFailed;
  }
  return ResponseCode::General;
}

Area area(std::uint8_t operand) {
  return static_cast<Area>(operand);
}

} // namespace

HANDLE(RunMacro) {
  const auto outcome = call.ball.macros().start(call.operands.u8(0), call.ball.now());
  call.ball.macros_changed();
  return {code(outcome), {}};
}

HANDLE(SaveTemporaryMacro) {
  const auto outcome = call.ball.macros().save_temporary(call.operands.data(), call.ball.now());
  call.ball.macros_changed();
  return {code(outcome), {}};
}

HANDLE(SaveMacro) {
  const auto outcome = call.ball.macros().save(call.operands.data(), call.ball.now());
  call.ball.macros_changed();
  return {code(outcome), {}};
}

HANDLE(ReinitMacroExecutive) {
  call.ball.macros().reinitialize(call.ball.now());
  call.ball.macros_changed();
  return {};
}

HANDLE(AbortMacro) {
  const auto aborted = call.ball.macros().abort(call.ball.now());
  call.ball.macros_changed();
  return call.answer({aborted.id, aborted.number});
}

HANDLE(GetMacroStatus) {
  const auto status = call.ball.macros().status();
  return call.answer({status.id, status.number});
}

HANDLE(SetMacroParameter) {
  const auto& values = call.operands;
  return {code(call.ball.macros().set_parameter(values.u8(0), values.u8(1), values.u8(2))), {}};
}

HANDLE(AppendMacroChunk) {
  const auto outcome = call.ball.macros().append_chunk(call.operands.data(), call.ball.now());
  call.ball.macros_changed();
  return {code(outcome), {}};
}

HANDLE(EraseOrbbasicStorage) {
  const auto outcome = call.ball.erase_basic(area(call.operands.u8(0)));
  if (area(call.operands.u8(0)) == Area::Flash)
    persist();
  return {code(outcome), {}};
}

HANDLE(AppendOrbbasicFragment) {
  const auto outcome = call.ball.append_basic(area(call.operands.u8(0)), call.operands.data());
  if (area(call.operands.u8(0)) == Area::Flash)
    persist();
  return {code(outcome), {}};
}

HANDLE(ExecuteOrbbasicProgram) {
  return {code(call.ball.execute_basic(area(call.operands.u8(0)),
                                       static_cast<int>(call.operands.number(1)))),
          {}};
}

HANDLE(AbortOrbbasicProgram) {
  call.ball.abort_basic();
  return {};
}

HANDLE(SubmitValueToInput) {
  call.ball.deliver_input(static_cast<std::int32_t>(call.operands.number(0)));
  return {};
}

HANDLE(CommitRamToFlash) {
  const auto outcome = call.ball.commit_basic();
  persist();
  return {code(outcome), {}};
}

HANDLE(CommitRamToFlash70) {
  return handle<spec::ApiCommand::CommitRamToFlash>(call);
}

} // namespace orb::vm
