// Device 02h: macros and orbBasic.

#include "vm/api/dispatch.h"

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
  case MacroOutcome::NoSuchMacro:
  case MacroOutcome::Busy:
  case MacroOutcome::Inhibited:
  case MacroOutcome::NoRoom: return ResponseCode::ExecuteFailed;
  }
  return ResponseCode::General;
}

Area area(std::uint8_t operand) {
  return static_cast<Area>(operand);
}

} // namespace

HANDLE(RunMacro) {
  return {code(host_->macros().start(call.operands.u8(0), host_->now())), {}};
}

HANDLE(SaveTemporaryMacro) {
  return {code(host_->macros().save_temporary(call.operands.data(), host_->now())), {}};
}

HANDLE(SaveMacro) {
  return {code(host_->macros().save(call.operands.data(), host_->now())), {}};
}

HANDLE(ReinitMacroExecutive) {
  host_->macros().reinitialize(host_->now());
  return {};
}

HANDLE(AbortMacro) {
  const auto aborted = host_->macros().abort(host_->now());
  return call.answer({aborted.id, aborted.number});
}

HANDLE(GetMacroStatus) {
  const auto status = host_->macros().status();
  return call.answer({status.id, status.number});
}

HANDLE(SetMacroParameter) {
  const auto& values = call.operands;
  return {code(host_->macros().set_parameter(values.u8(0), values.u8(1), values.u8(2))), {}};
}

HANDLE(AppendMacroChunk) {
  return {code(host_->macros().append_chunk(call.operands.data(), host_->now())), {}};
}

HANDLE(EraseOrbbasicStorage) {
  const auto outcome = host_->programs().erase(area(call.operands.u8(0)));
  if (area(call.operands.u8(0)) == Area::Flash)
    persist();
  return {code(outcome), {}};
}

HANDLE(AppendOrbbasicFragment) {
  const auto outcome = host_->programs().append(area(call.operands.u8(0)), call.operands.data());
  if (area(call.operands.u8(0)) == Area::Flash)
    persist();
  return {code(outcome), {}};
}

HANDLE(ExecuteOrbbasicProgram) {
  return {code(host_->programs().execute(area(call.operands.u8(0)),
                                         static_cast<int>(call.operands.number(1)), host_->now())),
          {}};
}

HANDLE(AbortOrbbasicProgram) {
  host_->programs().abort();
  return {};
}

HANDLE(SubmitValueToInput) {
  host_->programs().deliver(static_cast<std::int32_t>(call.operands.number(0)), host_->now());
  return {};
}

HANDLE(CommitRamToFlash) {
  const auto outcome = host_->programs().commit();
  persist();
  return {code(outcome), {}};
}

HANDLE(CommitRamToFlash70) {
  return handle<spec::ApiCommand::CommitRamToFlash>(call);
}

} // namespace orb::vm
