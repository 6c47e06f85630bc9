#include "uploader/plan.h"

#include "spec/firmware.h"
#include "spec/limits.h"
#include "uploader/session.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::uploader {
namespace {

using protocol::Command;
using protocol::make_command;
using spec::ApiCommand;
using spec::Limit;

constexpr std::size_t fragment_most = spec::max_payload - 1; // the area byte
/// Of a streamed piece, id and flags included; what the vendor's clients send.
constexpr std::size_t stream_piece_most = 250;
/// A fragment is shortened at most this much to be safe against a change of DLEN: each of its 8
/// bits forbids one sequence number for a length.
constexpr std::size_t shortened_most = 9;

std::size_t limit_bytes(Limit limit) {
  return static_cast<std::size_t>(spec::value_of(limit));
}

/// Numbers the packets as a session does.
class StepList {
public:
  explicit StepList(std::uint8_t first_seq) : seq_(first_seq) {}

  void add(StepKind kind, ApiCommand command, Bytes data = {}) {
    auto packet = make_command(command, std::move(data), seq_);
    while (survives_shorter(packet)) {
      steps_.push_back({kind, make_command(ApiCommand::Ping, {}, seq_)});
      packet.seq = ++seq_;
    }
    ++seq_;
    steps_.push_back({kind, std::move(packet)});
  }

  std::uint8_t seq() const { return seq_; }
  std::vector<Step> take() { return std::move(steps_); }

private:
  std::uint8_t seq_;
  std::vector<Step> steps_;
};

void greet(StepList& steps) {
  steps.add(StepKind::Greet, ApiCommand::Ping);
  steps.add(StepKind::Greet, ApiCommand::GetVersioning);
  steps.add(StepKind::Greet, ApiCommand::GetPowerState);
}

Duration greeting_time(const Budgets& budgets) {
  constexpr int questions = 3;
  return budgets.opens * budgets.connect + budgets.backoffs(budgets.opens) + budgets.drain +
         questions * budgets.ask();
}

/// One packet that must arrive exactly once.
Duration piece_time(const Budgets& budgets) {
  return (1 + budgets.resends) * budgets.answer + budgets.backoffs(1 + budgets.resends);
}

Bytes u8(std::uint8_t value) {
  return {value};
}

Bytes run_data(Area area, std::uint16_t line) {
  Bytes data = {static_cast<std::uint8_t>(area)};
  append_u16(data, line);
  return data;
}

} // namespace

Firmware read_firmware(ByteView record) {
  const auto field = [&](std::size_t at) {
    return at < record.size() ? record[at] : std::uint8_t{0};
  };
  const spec::Revision api{field(spec::version_api_at), field(spec::version_api_at + 1)};
  return {.ram_bytes = spec::ram_bytes_of(api),
          .flash_bytes = limit_bytes(Limit::FlashBytes),
          .has_basic = field(spec::version_orbbasic_at) != 0,
          .can_commit = api >= spec::info(ApiCommand::CommitRamToFlash).since};
}

Firmware default_firmware() {
  return read_firmware(spec::info(spec::default_firmware).record());
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

Route choose_route(const ProgramJob& job, const Firmware& firmware) {
  if (job.area == Area::Ram)
    return Route::Ram;
  return firmware.can_commit && job.image.size() <= firmware.ram_bytes ? Route::RamThenFlash
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

MacroKind natural_kind(const protocol::MacroImage& image) {
  if (image.id == spec::macro_id_stream)
    return MacroKind::Stream;
  if (spec::macro_id_kind(image.id) == spec::MacroIdKind::User)
    return MacroKind::User;
  return encode(image).size() <= spec::macro_buffer_planned ? MacroKind::Temporary
                                                            : MacroKind::Stream;
}

Bytes fragment_data(Area area, ByteView piece) {
  Bytes data = {static_cast<std::uint8_t>(area)};
  data.insert(data.end(), piece.begin(), piece.end());
  return data;
}

std::size_t fragment_size(Area area, ByteView rest, std::uint8_t seq) {
  const auto most = std::min(rest.size(), fragment_most);
  for (auto size = most; size > 0 && size + shortened_most >= most; --size)
    if (!survives_shorter(make_command(ApiCommand::AppendOrbbasicFragment,
                                       fragment_data(area, rest.first(size)), seq)))
      return size;
  return most; // the session moves the sequence number on instead
}

std::size_t chunk_size(ByteView rest, std::uint8_t seq) {
  const auto most = std::min(rest.size(), spec::max_payload);
  for (auto size = most; size > 0 && size + shortened_most >= most; --size)
    if (!survives_shorter(make_command(ApiCommand::AppendMacroChunk,
                                       {rest.begin(), rest.begin() + static_cast<long>(size)},
                                       seq)))
      return size;
  return most;
}

tl::expected<Plan, PlanError> make_plan(const ProgramJob& job, const Firmware& firmware,
                                        const Budgets& budgets, std::uint8_t first_seq) {
  if (!firmware.has_basic)
    return tl::unexpected(PlanError{"this ball has no orbBasic; only macros run on it"});
  Plan plan;
  plan.route = choose_route(job, firmware);
  plan.size = job.image.size();
  const auto room = job.area == Area::Ram ? firmware.ram_bytes : firmware.flash_bytes;
  if (plan.size > room)
    return tl::unexpected(
        PlanError{fmt::format("the program has {} bytes, the {} area of this ball {}; {}",
                              plan.size, job.area == Area::Ram ? "RAM" : "flash", room,
                              job.area == Area::Ram && plan.size <= firmware.flash_bytes
                                  ? "use `--area flash`"
                                  : "`orb build --pack` makes it smaller")});
  if (plan.route == Route::FlashDirectly)
    plan.note = fmt::format("{}: flash is erased and written directly, so a failure loses "
                            "the program that is there now",
                            firmware.can_commit ? "the program is larger than the RAM of this ball"
                                                : "this firmware cannot commit RAM to flash");
  const auto target = plan.route == Route::FlashDirectly ? Area::Flash : Area::Ram;

  StepList steps(first_seq);
  greet(steps);
  steps.add(StepKind::Prepare, ApiCommand::AbortOrbbasicProgram);
  steps.add(StepKind::Prepare, ApiCommand::EraseOrbbasicStorage,
            u8(static_cast<std::uint8_t>(target)));
  for (ByteView rest = job.image; !rest.empty(); ++plan.pieces) {
    const auto size = fragment_size(target, rest, steps.seq());
    steps.add(StepKind::Append, ApiCommand::AppendOrbbasicFragment,
              fragment_data(target, rest.first(size)));
    rest = rest.subspan(size);
  }
  steps.add(StepKind::Barrier, ApiCommand::Ping);
  if (plan.route == Route::RamThenFlash)
    steps.add(StepKind::Store, ApiCommand::CommitRamToFlash);
  if (job.start_line)
    steps.add(StepKind::Start, ApiCommand::ExecuteOrbbasicProgram,
              run_data(job.area, *job.start_line));
  plan.steps = steps.take();

  // Under other sequence numbers other fragments are shortened.
  const auto shortest = fragment_most - shortened_most;
  const auto pieces = static_cast<int>((plan.size + shortest - 1) / shortest);
  const auto attempt = 2 * budgets.ask() + pieces * piece_time(budgets) + budgets.ask();
  plan.deadline =
      greeting_time(budgets) + budgets.attempts * attempt + budgets.backoffs(budgets.attempts);
  if (plan.route == Route::RamThenFlash)
    plan.deadline += budgets.ask();
  if (job.start_line)
    plan.deadline += piece_time(budgets) + budgets.start_sign;
  return plan;
}

tl::expected<std::vector<Bytes>, PlanError> stream_pieces(const protocol::MacroImage& image) {
  const auto listing = protocol::decode_macro_body(image.body);
  if (listing.error)
    return tl::unexpected(PlanError{fmt::format("the macro cannot be cut into commands: {}",
                                                protocol::to_string(*listing.error))});
  protocol::MacroImage head = image;
  head.id = spec::macro_id_stream;
  head.body.clear();
  const auto header = encode(head);
  std::vector<Bytes> pieces = {header};
  auto ends = false;
  const auto add = [&](ByteView command) {
    if (pieces.back().size() + command.size() > stream_piece_most)
      pieces.push_back(header);
    pieces.back().insert(pieces.back().end(), command.begin(), command.end());
  };
  for (const auto& step : listing.steps) {
    if (step.size + header.size() > stream_piece_most)
      return tl::unexpected(PlanError{fmt::format(
          "the {} at offset {} takes {} bytes; a streamed piece holds {}", step.info->mnemonic,
          step.offset, step.size, stream_piece_most - header.size())});
    ends = ends || step.info->command == spec::MacroCommand::StreamEnd;
    add(ByteView(image.body).subspan(step.offset, step.size));
  }
  if (!ends)
    add(u8(static_cast<std::uint8_t>(spec::MacroCommand::StreamEnd)));
  return pieces;
}

tl::expected<Plan, PlanError> make_plan(const MacroJob& job, const Budgets& budgets,
                                        std::uint8_t first_seq) {
  Plan plan;
  plan.route = choose_route(job);
  auto image = job.image;
  if (plan.route == Route::TemporaryPacket || plan.route == Route::TemporaryChunks)
    image.id = spec::macro_id_temporary;
  const auto bytes = encode(image);
  plan.size = bytes.size();

  StepList steps(first_seq);
  greet(steps);
  steps.add(StepKind::Prepare, ApiCommand::AbortMacro);
  if (job.clear_others) {
    steps.add(StepKind::Prepare, ApiCommand::ReinitMacroExecutive);
    plan.deadline += budgets.ask();
  }
  auto runs = job.run;
  switch (plan.route) {
  case Route::TemporaryPacket:
    steps.add(StepKind::Store, ApiCommand::SaveTemporaryMacro, bytes);
    plan.pieces = 1;
    break;
  case Route::TemporaryChunks:
    if (plan.size > spec::macro_buffer_planned)
      return tl::unexpected(PlanError{
          fmt::format("the macro has {} bytes, a temporary macro at most {}; use `--as stream`",
                      plan.size, spec::macro_buffer_planned)});
    for (ByteView rest = bytes; !rest.empty(); ++plan.pieces) {
      const auto size = chunk_size(rest, steps.seq());
      steps.add(StepKind::Append, ApiCommand::AppendMacroChunk,
                {rest.begin(), rest.begin() + static_cast<long>(size)});
      rest = rest.subspan(size);
    }
    break;
  case Route::UserMacro:
    if (plan.size > spec::macro_max_packet)
      return tl::unexpected(PlanError{
          fmt::format("the macro has {} bytes, a user macro at most {}; use `--as temp` or "
                      "`--as stream`",
                      plan.size, spec::macro_max_packet)});
    if (spec::macro_id_kind(image.id) != spec::MacroIdKind::User)
      return tl::unexpected(PlanError{
          fmt::format("a user macro has an id from {} to {}, not {}; choose one with `--id`",
                      spec::macro_id_user_first, spec::macro_id_user_last, image.id)});
    steps.add(StepKind::Store, ApiCommand::SaveMacro, bytes);
    plan.pieces = 1;
    plan.note = "the ball forgets user macros when it sleeps";
    break;
  case Route::StreamedMacro: {
    const auto pieces = stream_pieces(image);
    if (!pieces)
      return tl::unexpected(pieces.error());
    for (const auto& piece : *pieces)
      steps.add(StepKind::Append, ApiCommand::SaveMacro, piece);
    plan.pieces = pieces->size();
    runs = false;
    plan.note = "a streamed macro runs while it arrives and is not stored";
    break;
  }
  case Route::Ram:
  case Route::RamThenFlash:
  case Route::FlashDirectly: break; // programs
  }
  steps.add(StepKind::Barrier, ApiCommand::Ping);
  if (runs)
    steps.add(StepKind::Start, ApiCommand::RunMacro, u8(image.id));
  plan.steps = steps.take();

  constexpr int seq_moves_most = 8;
  const auto pieces = static_cast<int>(plan.pieces) + (plan.pieces > 1 ? 1 : 0);
  auto piece = piece_time(budgets) + seq_moves_most * budgets.answer;
  if (plan.route == Route::StreamedMacro)
    piece += budgets.stream_room;
  plan.deadline += greeting_time(budgets) + 3 * budgets.ask() + pieces * piece;
  if (runs)
    plan.deadline += piece_time(budgets) + budgets.ask();
  return plan;
}

} // namespace orb::uploader
