#include "uploader/plan.h"

#include "spec/firmware.h"
#include "uploader/session.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::uploader {
namespace {

using protocol::Command;
using protocol::MacroImage;
using protocol::make_command;
using spec::ApiCommand;
using spec::Limit;

/// How much a piece may be shortened to survive a change of DLEN: each of its 8 bits excludes one
/// sequence number per length.
constexpr std::size_t shortened_most = 9;
constexpr int seq_moves_most = 8; ///< or pings that advance the sequence number

tl::unexpected<PlanError> impossible(std::string message) {
  return tl::unexpected(PlanError{std::move(message)});
}

Bytes u8(std::uint8_t value) {
  return {value};
}
Bytes u8(Area area) {
  return {static_cast<std::uint8_t>(area)};
}

Bytes run_data(Area area, std::uint16_t line) {
  auto data = u8(area);
  append_u16(data, line);
  return data;
}

Bytes joined(const Bytes& front, ByteView back) {
  auto bytes = front;
  bytes.insert(bytes.end(), back.begin(), back.end());
  return bytes;
}

std::size_t piece_most(const Step& step) {
  return spec::max_payload - step.data.size();
}

/// The number of packets for the content if each is shorter by `shortened` than possible.
std::size_t pieces_of(const Step& step, std::size_t shortened) {
  const auto size = piece_most(step) - shortened;
  return step.cuts.empty() ? (step.content.size() + size - 1) / size : step.cuts.size();
}

// The deadline.

/// For a packet that must arrive exactly once.
Duration once_time(const Budgets& budgets) {
  return (1 + budgets.resends) * (budgets.send + budgets.answer) +
         budgets.backoffs(1 + budgets.resends);
}

Duration step_time(const Step& step, const Budgets& budgets) {
  const auto seq_moves = seq_moves_most * (budgets.send + budgets.answer);
  const auto once = once_time(budgets);
  switch (step.kind) {
  case StepKind::Prepare:
  case StepKind::Erase:
  case StepKind::Count:
  case StepKind::Barrier: return budgets.ask();
  case StepKind::Append: {
    const auto piece = step.cuts.empty() ? once : once + seq_moves + budgets.stream_room;
    return static_cast<int>(pieces_of(step, shortened_most)) * piece;
  }
  case StepKind::Store:
    return spec::info(step.command).idempotent == spec::Idempotent::No ? 2 * (once + seq_moves)
           : step.data.empty()                                         ? budgets.ask()
                               : budgets.ask() + budgets.sends * seq_moves;
  case StepKind::Start: return budgets.settle + once + seq_moves + budgets.ask();
  }
  return {};
}

/// The sum of the greeting, the steps up to the barrier for each attempt, the other steps once, and
/// a final abort.
Duration deadline(const Plan& plan, const Budgets& budgets) {
  constexpr int greeting_questions = 3;
  constexpr int counting_questions = 8; // does the ball count packets, and as we do?
  auto time = budgets.open() + budgets.drain + budgets.backoffs(plan.attempts) +
              (greeting_questions + 1) * budgets.ask();
  auto times = plan.attempts;
  for (const auto& step : plan.steps) {
    time += times * step_time(step, budgets);
    if (step.kind == StepKind::Count)
      time += counting_questions * budgets.ask();
    if (step.kind == StepKind::Barrier)
      times = 1;
  }
  return time;
}

/// Estimates the time on this link: each packet waits for its answer and, on a link with pieces,
/// each piece for its acknowledgement.
void estimate(Plan& plan, const Budgets& budgets) {
  const auto sent = packets(plan, 0);
  plan.expected = budgets.drain + static_cast<int>(sent.size()) * budgets.round_trip;
  if (budgets.piece == 0)
    return;
  for (const auto& packet : sent)
    plan.link_pieces += budgets.pieces(encode(packet).size());
  plan.expected = static_cast<int>(plan.link_pieces + sent.size()) * budgets.receipt;
}

// Programs.

std::string note_of(Route route, const Capabilities& ball) {
  if (route != Route::FlashDirectly)
    return {};
  return fmt::format("{}: flash is erased and written directly, so a failure loses the program "
                     "that is there now",
                     ball.can_commit ? "the program is larger than the RAM of this ball"
                                     : "this firmware cannot commit RAM to flash");
}

std::optional<PlanError> misfit(const ProgramJob& job, const Capabilities& ball) {
  if (!ball.has_basic)
    return PlanError{"this ball has no orbBasic; only macros run on it"};
  const auto size = job.image.size();
  const auto in_ram = job.area == Area::Ram;
  const auto room = in_ram ? ball.ram_bytes : ball.flash_bytes;
  if (size <= room)
    return std::nullopt;
  return PlanError{fmt::format("the program is {} bytes; the {} area of this ball holds {}; {}",
                               size, in_ram ? "RAM" : "flash", room,
                               in_ram && size <= ball.flash_bytes
                                   ? "use `--area flash`"
                                   : "`orb build --pack` makes it smaller")};
}

// Macros.

bool is_temporary(Route route) {
  return route == Route::TemporaryPacket || route == Route::TemporaryChunks;
}

std::string_view note_of(Route route) {
  return route == Route::UserMacro ? "user macros are lost when the ball sleeps"
         : route == Route::StreamedMacro
             ? "a streamed macro runs while it arrives and is not stored"
             : "";
}

std::optional<PlanError> misfit(Route route, const MacroImage& image, std::size_t size) {
  if (route == Route::TemporaryChunks && size > spec::macro_buffer_planned)
    return PlanError{
        fmt::format("the macro is {} bytes; a temporary macro can be at most {}; use `--as stream`",
                    size, spec::macro_buffer_planned)};
  if (route != Route::UserMacro)
    return std::nullopt;
  if (size > spec::macro_max_packet)
    return PlanError{
        fmt::format("the macro is {} bytes; a user macro can be at most {}; use `--as temp` "
                    "or `--as stream`",
                    size, spec::macro_max_packet)};
  if (spec::macro_id_kind(image.id) != spec::MacroIdKind::User)
    return PlanError{
        fmt::format("a user macro has an id from {} to {}, not {}; choose one with `--id`",
                    spec::macro_id_user_first, spec::macro_id_user_last, image.id)};
  return std::nullopt;
}

/// Splits a macro into pieces of whole commands, each preceded by id and flags. Appends Stream End
/// if it is missing. Fails if a comment is longer than a piece.
tl::expected<Step, PlanError> stream_step(MacroImage image) {
  const auto listing = protocol::decode_macro_body(image.body);
  if (listing.error)
    return impossible(fmt::format("the macro cannot be split into commands: {}",
                                  protocol::to_string(*listing.error)));
  Step step{StepKind::Append, ApiCommand::SaveMacro, {}, std::move(image.body), {0}};
  image.id = spec::macro_id_stream;
  image.body.clear();
  step.data = encode(image);
  const auto room = spec::macro_stream_piece - step.data.size();
  const auto add = [&](std::size_t size) {
    if (step.cuts.back() + size > room)
      step.cuts.push_back(0);
    step.cuts.back() += size;
  };
  for (const auto& command : listing.steps) {
    if (command.size > room)
      return impossible(fmt::format("the {} at offset {} takes {} bytes; a streamed piece holds {}",
                                    command.info->mnemonic, command.offset, command.size, room));
    add(command.size);
  }
  const auto ends = [](const protocol::MacroStep& command) {
    return command.info->command == spec::MacroCommand::StreamEnd;
  };
  if (std::none_of(listing.steps.begin(), listing.steps.end(), ends)) {
    step.content.push_back(static_cast<std::uint8_t>(spec::MacroCommand::StreamEnd));
    add(1);
  }
  return step;
}

/// Returns the step that transfers the macro itself.
tl::expected<Step, PlanError> bring(Route route, const MacroImage& image) {
  switch (route) {
  case Route::TemporaryPacket:
    return Step{StepKind::Store, ApiCommand::SaveTemporaryMacro, encode(image)};
  case Route::TemporaryChunks:
    return Step{StepKind::Append, ApiCommand::AppendMacroChunk, {}, encode(image)};
  case Route::UserMacro: return Step{StepKind::Store, ApiCommand::SaveMacro, encode(image)};
  case Route::StreamedMacro: return stream_step(image);
  case Route::Ram:
  case Route::RamThenFlash:
  case Route::FlashDirectly: break; // used for programs only
  }
  return Step{};
}

} // namespace

Capabilities read_capabilities(ByteView record) {
  const auto field = [&](std::size_t at) {
    return at < record.size() ? record[at] : std::uint8_t{0};
  };
  const auto orbbasic = field(spec::version_orbbasic_at);
  const auto api =
      std::max(spec::Revision{field(spec::version_api_at), field(spec::version_api_at + 1)},
               spec::api_of(orbbasic));
  return {.ram_bytes = spec::ram_bytes_of(api),
          .flash_bytes = static_cast<std::size_t>(spec::value_of(Limit::FlashBytes)),
          .has_basic = orbbasic != 0,
          .language = spec::language_of(orbbasic, api),
          .macro_executive = field(spec::version_macro_at),
          .can_commit = api >= spec::info(ApiCommand::CommitRamToFlash).since,
          .in_bootloader = field(spec::version_firmware_at) == 0 &&
                           field(spec::version_firmware_at + 1) == 0 && orbbasic == 0 &&
                           field(spec::version_macro_at) == 0};
}

Capabilities default_capabilities() {
  return read_capabilities(spec::info(spec::default_firmware).record());
}

std::string_view to_string(Route route) {
  switch (route) {
  case Route::Ram: return "RAM";
  case Route::RamThenFlash: return "RAM, then committed to flash";
  case Route::FlashDirectly: return "flash";
  case Route::TemporaryPacket: return "temporary macro";
  case Route::TemporaryChunks: return "temporary macro in chunks";
  case Route::UserMacro: return "user macro";
  case Route::StreamedMacro: return "streamed macro";
  }
  return {};
}

Route choose_route(const ProgramJob& job, const Capabilities& ball) {
  if (job.area == Area::Ram)
    return Route::Ram;
  return ball.can_commit && job.image.size() <= ball.ram_bytes ? Route::RamThenFlash
                                                               : Route::FlashDirectly;
}

Route choose_route(const MacroJob& job) {
  switch (job.kind) {
  case MacroKind::User: return Route::UserMacro;
  case MacroKind::Stream: return Route::StreamedMacro;
  case MacroKind::Temporary: break;
  }
  return encode(job.image).size() <= spec::macro_max_packet ? Route::TemporaryPacket
                                                            : Route::TemporaryChunks;
}

MacroKind natural_kind(const MacroImage& image) {
  if (image.id == spec::macro_id_stream)
    return MacroKind::Stream;
  if (spec::macro_id_kind(image.id) == spec::MacroIdKind::User)
    return MacroKind::User;
  return encode(image).size() <= spec::macro_buffer_planned ? MacroKind::Temporary
                                                            : MacroKind::Stream;
}

Bytes piece_data(const Step& step, ByteView piece) {
  return joined(step.data, piece);
}

ByteView next_piece(const Step& step, std::size_t sent, std::size_t piece, std::uint8_t seq) {
  const auto rest = ByteView(step.content).subspan(sent);
  if (!step.cuts.empty())
    return rest.first(step.cuts[piece]);
  const auto most = std::min(rest.size(), piece_most(step));
  for (auto size = most; size > 0 && size + shortened_most >= most; --size)
    if (!survives_shorter(make_command(step.command, piece_data(step, rest.first(size)), seq)))
      return rest.first(size);
  return rest.first(most); // the session advances the sequence number instead
}

tl::expected<Plan, PlanError> make_plan(const ProgramJob& job, const Capabilities& ball,
                                        const Budgets& budgets) {
  if (const auto error = misfit(job, ball))
    return tl::unexpected(*error);
  Plan plan;
  plan.route = choose_route(job, ball);
  plan.attempts = budgets.attempts;
  plan.size = job.image.size();
  plan.note = note_of(plan.route, ball);
  const auto target = plan.route == Route::FlashDirectly ? Area::Flash : Area::Ram;
  plan.steps = {
      {StepKind::Prepare, ApiCommand::AbortOrbbasicProgram},
      {StepKind::Erase, ApiCommand::EraseOrbbasicStorage, u8(target)},
      {StepKind::Count, ApiCommand::PerformLevel2Diagnostics},
      {StepKind::Append, ApiCommand::AppendOrbbasicFragment, u8(target), job.image},
      {StepKind::Barrier, ApiCommand::PerformLevel2Diagnostics},
  };
  plan.pieces = pieces_of(plan.steps[3], 0);
  if (plan.route == Route::RamThenFlash)
    plan.steps.push_back({StepKind::Store, ApiCommand::CommitRamToFlash});
  if (job.start_line)
    plan.steps.push_back(
        {StepKind::Start, ApiCommand::ExecuteOrbbasicProgram, run_data(job.area, *job.start_line)});
  estimate(plan, budgets);
  plan.deadline = deadline(plan, budgets);
  return plan;
}

tl::expected<Plan, PlanError> make_plan(const MacroJob& job, const Budgets& budgets) {
  Plan plan;
  plan.route = choose_route(job);
  plan.note = note_of(plan.route);
  auto image = job.image;
  if (is_temporary(plan.route))
    image.id = spec::macro_id_temporary;
  plan.size = encode(image).size();
  if (const auto error = misfit(plan.route, image, plan.size))
    return tl::unexpected(*error);
  auto macro = bring(plan.route, image);
  if (!macro)
    return tl::unexpected(macro.error());
  const auto in_pieces = macro->kind == StepKind::Append;
  plan.pieces = in_pieces ? pieces_of(*macro, 0) : 1;
  plan.steps = {{StepKind::Prepare, ApiCommand::AbortMacro}};
  if (job.clear_others)
    plan.steps.push_back({StepKind::Erase, ApiCommand::ReinitMacroExecutive});
  const auto count = in_pieces ? ApiCommand::PerformLevel2Diagnostics : ApiCommand::Ping;
  if (in_pieces)
    plan.steps.push_back({StepKind::Count, count});
  plan.steps.push_back(*std::move(macro));
  plan.steps.push_back({StepKind::Barrier, count});
  if (job.run && plan.route != Route::StreamedMacro)
    plan.steps.push_back({StepKind::Start, ApiCommand::RunMacro, u8(image.id)});
  estimate(plan, budgets);
  plan.deadline = deadline(plan, budgets);
  return plan;
}

std::vector<Command> packets(const Plan& plan, std::uint8_t seq) {
  std::vector<Command> out;
  const auto add = [&](ApiCommand command, const Bytes& data) {
    auto packet = make_command(command, data, seq);
    while (survives_shorter(packet)) { // skip the same numbers as a session
      out.push_back(make_command(ApiCommand::Ping, {}, seq));
      packet.seq = ++seq;
    }
    ++seq;
    out.push_back(std::move(packet));
  };
  for (const auto question :
       {ApiCommand::Ping, ApiCommand::GetVersioning, ApiCommand::GetPowerState})
    add(question, {});
  for (const auto& step : plan.steps) {
    if (step.kind != StepKind::Append)
      add(step.command, step.data);
    for (std::size_t sent = 0, number = 0; sent < step.content.size(); ++number) {
      const auto piece = next_piece(step, sent, number, seq);
      sent += piece.size();
      add(step.command, piece_data(step, piece));
    }
  }
  return out;
}

} // namespace orb::uploader
