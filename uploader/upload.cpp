#include "uploader/upload.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::uploader {
namespace {

using protocol::LinkError;
using protocol::Response;
using spec::ApiCommand;
using spec::Retry;

constexpr auto power_state_at = spec::answer_offset(ApiCommand::GetPowerState, "power state");

Retry retry_of(std::uint8_t code) {
  const auto* row = spec::find_response(code);
  return row == nullptr ? Retry::No : row->retry;
}

bool is_ok(const Response& response) {
  return response.code == static_cast<std::uint8_t>(spec::ResponseCode::Ok);
}

bool comes_round(std::uint8_t code) {
  return code == static_cast<std::uint8_t>(spec::ResponseCode::MemoryBusy);
}

double seconds(Duration duration) {
  return static_cast<double>(duration.count()) / 1e9;
}

/// `RAM holds part of the program`: what is where, for the end of a message.
std::string describe(Content content, Route route) {
  const auto committed = route == Route::RamThenFlash;
  const std::string_view place = route == Route::FlashDirectly ? "flash" : "RAM";
  const auto is_program =
      route == Route::Ram || route == Route::RamThenFlash || route == Route::FlashDirectly;
  if (!is_program) {
    switch (content) {
    case Content::Unchanged: return "the ball's macros are unchanged";
    case Content::ErasedOrUnchanged: return "the ball's macros may have been cleared";
    case Content::Erased: return "the ball's macros have been cleared";
    case Content::Incomplete: return "the ball may hold a part of the macro";
    case Content::Uncommitted:
    case Content::Unconfirmed: return "the macro may be there or not";
    case Content::Stored: return "the macro is stored";
    }
  }
  const auto tail = committed ? "; the program in flash is unchanged" : "";
  switch (content) {
  case Content::Unchanged: return "the ball's programs are unchanged";
  case Content::ErasedOrUnchanged:
    return fmt::format("the program in {} is erased or unchanged{}", place, tail);
  case Content::Erased: return fmt::format("the program in {} is erased{}", place, tail);
  case Content::Incomplete: return fmt::format("the program in {} is incomplete{}", place, tail);
  case Content::Uncommitted: return "the program is in RAM, the one in flash is unchanged";
  case Content::Unconfirmed:
    return committed ? "the program in flash is the old one or the new one"
                     : fmt::format("whether the program in {} is complete is not known", place);
  case Content::Stored:
    return fmt::format("the program is stored in {}", committed ? "flash" : place);
  }
  return {};
}

/// Carries one job out: knows what is on the ball at each moment.
class Job {
public:
  /// Without a route nothing is said of what is on the ball.
  Job(Session& session, Progress& progress, std::optional<Route> route)
      : session_(session), progress_(progress), route_(route) {}

  Status status;
  Content content = Content::Unchanged;

  Session& session() { return session_; }

  void show(Stage stage) {
    status.stage = stage;
    progress_.on_status(status, session_.now());
  }

  Report done(std::string message) const {
    return {Report::Kind::Done, Content::Stored, std::move(message), 0};
  }

  Report refused(ApiCommand command, const Response& response) const {
    const auto* row = spec::find_response(response.code);
    return {Report::Kind::Refused, content,
            fmt::format("the ball refused {}: {}{}{}{}", spec::info(command).name,
                        describe_code(response.code), state(),
                        row == nullptr || row->remedy.empty() ? "" : "; ",
                        row == nullptr ? "" : row->remedy),
            response.code};
  }

  /// No answer, or none but "damaged": with what is on the ball now.
  Report lost(ApiCommand command, const NoAnswer& failure) const {
    const auto unknown = content == Content::Unconfirmed;
    Report report{unknown ? Report::Kind::Unknown : Report::Kind::LinkLost, content, {}, 0};
    std::string what;
    if (failure.kind == NoAnswer::Kind::TimedOut) {
      what = fmt::format("the ball stopped answering: nothing to {} within {:g} s",
                         spec::info(command).name, seconds(session_.budgets().answer));
    } else if (failure.link.kind == LinkError::Kind::Interrupted) {
      report.kind = Report::Kind::Interrupted;
      what = "interrupted";
    } else {
      what = fmt::format("link lost during {}: {}", spec::info(command).name, failure.link.message);
    }
    report.message =
        fmt::format("{}{}{}", what, state(), unknown || !route_ ? "" : "; upload again");
    return report;
  }

  /// Sends a harmless command until it is answered; nothing when the answer is OK.
  std::optional<Report> ask(ApiCommand command, const Bytes& data = {},
                            std::optional<Content> if_refused = std::nullopt) {
    const auto answer = session_.ask(command, data);
    if (!answer)
      return lost(command, answer.error());
    if (is_ok(*answer))
      return std::nullopt;
    if (retry_of(answer->code) == Retry::SameAgain)
      return lost(command, NoAnswer{});
    content = if_refused.value_or(content);
    return refused(command, *answer);
  }

private:
  Session& session_;
  Progress& progress_;
  /// What is on the ball, behind a message.
  std::string state() const { return route_ ? "; " + describe(content, *route_) : std::string(); }

  std::optional<Route> route_;
};

/// What came of sending a piece or all pieces once.
enum class Sent : std::uint8_t { Whole, StartOver };

/// What a second answer means: a piece stored twice, or nothing, as for a start, of which the ball
/// refuses the second.
enum class Duplicates : std::uint8_t { Matter, DoNotMatter };

/// Sends one packet that must be carried out exactly once. `data` makes it for the sequence number
/// that comes next, so that a resend can be cut differently. An answer other than OK is returned
/// only where sending again does not help.
template <class MakeData>
tl::expected<std::optional<Response>, NoAnswer>
send_once(Session& session, ApiCommand command, Duplicates duplicates, const MakeData& data) {
  for (int resend = 0; resend <= session.budgets().resends; ++resend) {
    const auto answer = session.exchange(command, data());
    if (!answer && answer.error().kind == NoAnswer::Kind::Link)
      return tl::unexpected(answer.error());
    if (!answer || (duplicates == Duplicates::Matter && session.duplicate_seen()))
      return std::nullopt;
    if (comes_round(answer->code)) {
      if (const auto waited = session.listen(session.now() + session.budgets().backoff(resend + 1));
          !waited)
        return tl::unexpected(waited.error());
    } else if (retry_of(answer->code) != Retry::SameAgain) {
      return *answer;
    }
  }
  return std::nullopt;
}

tl::expected<Sent, Report> send_program(Job& job, ByteView image, Area area) {
  job.status.bytes_sent = 0;
  job.status.packets = 0;
  while (job.status.bytes_sent < image.size()) {
    job.show(Stage::Sending);
    const auto rest = image.subspan(job.status.bytes_sent);
    std::size_t size = 0;
    job.content = Content::Incomplete;
    const auto answer =
        send_once(job.session(), ApiCommand::AppendOrbbasicFragment, Duplicates::Matter, [&] {
          size = fragment_size(area, rest, job.session().next_seq());
          return fragment_data(area, rest.first(size));
        });
    if (!answer)
      return tl::unexpected(job.lost(ApiCommand::AppendOrbbasicFragment, answer.error()));
    if (!*answer || retry_of((*answer)->code) == Retry::StartOver)
      return Sent::StartOver;
    if (!is_ok(**answer))
      return tl::unexpected(job.refused(ApiCommand::AppendOrbbasicFragment, **answer));
    job.status.bytes_sent += size;
    ++job.status.packets;
  }
  return Sent::Whole;
}

/// Waits until all answers of the ball have come through, and looks for second ones.
tl::expected<Sent, Report> barrier(Job& job) {
  job.show(Stage::Confirming);
  job.content = Content::Unconfirmed;
  if (auto failed = job.ask(ApiCommand::Ping))
    return tl::unexpected(*failed);
  return job.session().duplicate_seen() ? Sent::StartOver : Sent::Whole;
}

/// Erases and sends the program once.
tl::expected<Sent, Report> attempt(Job& job, ByteView image, Area area, Route route) {
  job.show(Stage::Preparing);
  if (auto failed = job.ask(ApiCommand::AbortOrbbasicProgram))
    return tl::unexpected(*failed);
  const auto before = job.content;
  if (before == Content::Unchanged)
    job.content = Content::ErasedOrUnchanged;
  if (auto failed =
          job.ask(ApiCommand::EraseOrbbasicStorage, {static_cast<std::uint8_t>(area)}, before))
    return tl::unexpected(*failed);
  job.content = Content::Erased;
  job.session().watch_duplicates();
  const auto sent = send_program(job, image, area);
  if (!sent || *sent == Sent::StartOver)
    return sent;
  auto confirmed = barrier(job);
  if (!confirmed && route == Route::RamThenFlash &&
      confirmed.error().kind == Report::Kind::Unknown) {
    // What the user asked for is flash, and that is untouched.
    confirmed.error().kind = Report::Kind::LinkLost;
    confirmed.error().content = Content::Incomplete;
    confirmed.error().message = fmt::format("the ball stopped answering; {}; upload again",
                                            describe(Content::Incomplete, route));
  }
  if (confirmed && *confirmed == Sent::StartOver)
    job.content = Content::Incomplete;
  return confirmed;
}

/// Whether a message shows that a program runs, or ran until now.
bool is_sign_of_life(const protocol::Async& message) {
  return message.id == static_cast<std::uint8_t>(spec::AsyncId::BasicPrint) ||
         message.id == static_cast<std::uint8_t>(spec::AsyncId::BasicErrorText) ||
         message.id == static_cast<std::uint8_t>(spec::AsyncId::BasicError);
}

std::optional<Report> start_program(Job& job, Area area, std::uint16_t line) {
  job.show(Stage::Starting);
  auto& session = job.session();
  auto& inbox = session.inbox();
  const auto seen = inbox.size();
  Bytes data = {static_cast<std::uint8_t>(area)};
  append_u16(data, line);
  const auto answer = send_once(session, ApiCommand::ExecuteOrbbasicProgram,
                                Duplicates::DoNotMatter, [&] { return data; });
  if (answer && *answer && is_ok(**answer))
    return std::nullopt;
  if (answer && *answer) {
    auto report = job.refused(ApiCommand::ExecuteOrbbasicProgram, **answer);
    return report;
  }
  const auto sign = [&] {
    return std::any_of(inbox.begin() + static_cast<long>(std::min(seen, inbox.size())), inbox.end(),
                       is_sign_of_life);
  };
  if (!answer && answer.error().link.kind == LinkError::Kind::Interrupted)
    return job.lost(ApiCommand::ExecuteOrbbasicProgram, answer.error());
  if (answer && session.listen(session.now() + session.budgets().start_sign, sign) && sign())
    return std::nullopt;
  return Report{Report::Kind::Unknown, Content::Stored,
                fmt::format("stored, start not confirmed: {}; the program is stored and may be "
                            "running",
                            answer ? "the ball did not answer" : answer.error().link.message),
                0};
}

/// A battery that might not last through a write to flash.
std::optional<Report> check_battery(const Greeting& greeting, BatteryPolicy policy) {
  const auto state = greeting.power_state();
  if (policy == BatteryPolicy::Ignore ||
      (state != spec::power_state::low && state != spec::power_state::critical))
    return std::nullopt;
  return Report{Report::Kind::Refused, Content::Unchanged,
                fmt::format("the battery is {} ({:02X}h), and a write to flash that is cut short "
                            "loses the program; the ball is unchanged; charge it, or use `--force`",
                            spec::value_name("power state", state), state),
                0};
}

/// Offers a piece of a stream until the buffer has room for it.
tl::expected<std::optional<Response>, NoAnswer> offer(Session& session, const Bytes& piece) {
  const auto patience = session.now() + session.budgets().stream_room;
  while (true) {
    const auto answer =
        send_once(session, ApiCommand::SaveMacro, Duplicates::Matter, [&] { return piece; });
    const auto full = answer && *answer && retry_of((*answer)->code) == Retry::Later;
    if (!full || session.now() >= patience)
      return answer;
    if (const auto waited = session.listen(session.now() + session.budgets().stream_pause); !waited)
      return tl::unexpected(waited.error());
  }
}

/// A lost answer to a chunk: what was stored is not known, so it is thrown away.
Report give_up_chunks(Job& job, ApiCommand command, const NoAnswer& failure) {
  job.content = Content::Unconfirmed;
  auto report = job.lost(command, failure);
  const auto link_works =
      failure.kind == NoAnswer::Kind::TimedOut || failure.link.kind == LinkError::Kind::Interrupted;
  if (link_works && job.session().ask(ApiCommand::AbortMacro))
    report.message += "; the macro was aborted";
  return report;
}

std::optional<Report> send_chunks(Job& job, ByteView image) {
  job.session().watch_duplicates();
  while (job.status.bytes_sent < image.size()) {
    job.show(Stage::Sending);
    const auto rest = image.subspan(job.status.bytes_sent);
    std::size_t size = 0;
    job.content = Content::Incomplete;
    const auto answer =
        send_once(job.session(), ApiCommand::AppendMacroChunk, Duplicates::Matter, [&] {
          size = chunk_size(rest, job.session().next_seq());
          return Bytes(rest.begin(), rest.begin() + static_cast<long>(size));
        });
    if (!answer || !*answer)
      return give_up_chunks(job, ApiCommand::AppendMacroChunk,
                            answer ? NoAnswer{} : answer.error());
    if (!is_ok(**answer))
      return job.refused(ApiCommand::AppendMacroChunk, **answer);
    job.status.bytes_sent += size;
    ++job.status.packets;
  }
  return std::nullopt;
}

std::optional<Report> send_stream(Job& job, const protocol::MacroImage& image) {
  const auto pieces = stream_pieces(image);
  job.session().watch_duplicates();
  for (const auto& piece : *pieces) { // the plan has made sure that there are some
    job.show(Stage::Sending);
    job.content = Content::Incomplete;
    const auto answer = offer(job.session(), piece);
    if (!answer || !*answer)
      return give_up_chunks(job, ApiCommand::SaveMacro, answer ? NoAnswer{} : answer.error());
    if (!is_ok(**answer)) {
      auto report = job.refused(ApiCommand::SaveMacro, **answer);
      if (job.session().ask(ApiCommand::AbortMacro))
        report.message += "; the macro was aborted";
      return report;
    }
    ++job.status.packets;
    job.status.bytes_sent = std::min(job.status.bytes_total, job.status.bytes_sent + piece.size());
  }
  return std::nullopt;
}

/// Which ids of user macros this upload knows to be free.
enum class IdKnown : std::uint8_t { No, Free };

std::optional<Report> save_user_macro(Job& job, const Bytes& image, IdKnown id) {
  job.show(Stage::Storing);
  auto& session = job.session();
  session.watch_duplicates();
  const auto first =
      send_once(session, ApiCommand::SaveMacro, Duplicates::DoNotMatter, [&] { return image; });
  if (first && *first) {
    if (is_ok(**first))
      return std::nullopt;
    auto report = job.refused(ApiCommand::SaveMacro, **first);
    report.message += ". An id that is in use cannot be replaced: choose another with `--id`, or "
                      "clear all macros of the ball with `--clear-macros`";
    return report;
  }
  job.content = Content::Unconfirmed;
  if (!first)
    return job.lost(ApiCommand::SaveMacro, first.error());
  // The answer is lost. Sent again, OK says that the first did not arrive; "exists" says that it
  // did, provided that the id was free.
  const auto second =
      send_once(session, ApiCommand::SaveMacro, Duplicates::DoNotMatter, [&] { return image; });
  if (second && *second && is_ok(**second))
    return std::nullopt;
  const auto exists = second && *second && retry_of((*second)->code) == Retry::Later;
  if (exists && id == IdKnown::Free)
    return std::nullopt;
  auto report = job.lost(ApiCommand::SaveMacro, second ? NoAnswer{} : second.error());
  if (exists)
    report.message = "the answer to save-macro was lost; the ball now has a macro with this id, "
                     "probably this one";
  return report;
}

std::optional<Report> start_macro(Job& job, std::uint8_t id) {
  job.show(Stage::Starting);
  auto& session = job.session();
  const auto answer =
      send_once(session, ApiCommand::RunMacro, Duplicates::DoNotMatter, [&] { return Bytes{id}; });
  if (answer && *answer) {
    if (is_ok(**answer))
      return std::nullopt;
    return job.refused(ApiCommand::RunMacro, **answer);
  }
  if (!answer && answer.error().link.kind == LinkError::Kind::Interrupted)
    return job.lost(ApiCommand::RunMacro, answer.error());
  if (answer) {
    const auto status = session.ask(ApiCommand::GetMacroStatus);
    if (status && is_ok(*status) && !status->data.empty() && status->data.front() == id)
      return std::nullopt;
  }
  return Report{Report::Kind::Unknown, Content::Stored,
                "stored, start not confirmed: the answer to run-macro was lost", 0};
}

/// Why nothing that answers like a ball is there, from what was heard.
std::string no_ball(const Session& session, const NoAnswer& failure) {
  const auto& counts = session.counts();
  if (failure.kind == NoAnswer::Kind::Link)
    return failure.link.message;
  const auto tried = fmt::format("no answer to {} pings", session.budgets().sends);
  if (counts.echoes > 0)
    return tried + "; what is sent comes back unchanged: this is an echo (a terminal, a loop-back "
                   "plug), not a ball";
  if (counts.foreign_answers > 0)
    return tried + "; answers came, but to other sequence numbers: another program is talking to "
                   "this ball, or it is not a ball";
  if (counts.bytes_in > 0)
    return fmt::format("{}; {} bytes came that are no answer: the other end is not a ball", tried,
                       counts.bytes_in);
  return tried + "; is the ball awake (shake it), charged and not connected to a phone?";
}

} // namespace

std::uint8_t Greeting::power_state() const {
  return power && power->size() > power_state_at ? (*power)[power_state_at] : std::uint8_t{0};
}

std::string_view to_string(Stage stage) {
  switch (stage) {
  case Stage::Greeting: return "greeting";
  case Stage::Preparing: return "preparing";
  case Stage::Sending: return "sending";
  case Stage::Confirming: return "confirming";
  case Stage::Storing: return "storing";
  case Stage::Starting: return "starting";
  case Stage::Done: return "done";
  }
  return {};
}

tl::expected<Greeting, Report> greet(Session& session) {
  const auto absent = [&](const NoAnswer& failure) {
    const auto interrupted =
        failure.kind == NoAnswer::Kind::Link && failure.link.kind == LinkError::Kind::Interrupted;
    return tl::unexpected(
        Report{interrupted ? Report::Kind::Interrupted : Report::Kind::NoBall, Content::Unchanged,
               interrupted ? "interrupted; the ball is unchanged" : no_ball(session, failure), 0});
  };
  if (const auto drained = session.drain(); !drained)
    return absent(drained.error());
  if (const auto pong = session.ask(ApiCommand::Ping); !pong)
    return absent(pong.error());
  Greeting greeting;
  const auto versions = request(session, ApiCommand::GetVersioning);
  if (!versions)
    return tl::unexpected(versions.error());
  greeting.versions = versions->data;
  greeting.firmware = read_firmware(greeting.versions);
  const auto power = session.ask(ApiCommand::GetPowerState);
  if (!power) {
    NullProgress nobody;
    return tl::unexpected(
        Job(session, nobody, std::nullopt).lost(ApiCommand::GetPowerState, power.error()));
  }
  if (is_ok(*power))
    greeting.power = power->data;
  return greeting;
}

tl::expected<Response, Report> request(Session& session, ApiCommand command, const Bytes& data) {
  NullProgress nobody;
  Job job(session, nobody, std::nullopt);
  const auto harmless = spec::info(command).idempotent == spec::Idempotent::Yes;
  const auto answer = harmless ? session.ask(command, data) : session.exchange(command, data);
  if (!answer) {
    auto report = job.lost(command, answer.error());
    if (!harmless && report.kind == Report::Kind::LinkLost) {
      report.kind = Report::Kind::Unknown;
      report.message = fmt::format("no answer to {}; whether the ball did it is not known",
                                   spec::info(command).name);
    }
    return tl::unexpected(report);
  }
  if (!is_ok(*answer))
    return tl::unexpected(job.refused(command, *answer));
  return *answer;
}

Report commit(Session& session, const Greeting& greeting, BatteryPolicy battery) {
  if (!greeting.firmware.can_commit)
    return {Report::Kind::Refused, Content::Unchanged,
            "this firmware cannot commit RAM to flash (API 1.47 can); upload with `--area flash`",
            0};
  if (auto low = check_battery(greeting, battery))
    return *low;
  NullProgress nobody;
  Job job(session, nobody, Route::RamThenFlash);
  if (auto failed = job.ask(ApiCommand::AbortOrbbasicProgram))
    return *failed;
  job.content = Content::Unconfirmed;
  if (auto failed = job.ask(ApiCommand::CommitRamToFlash, {}, Content::Uncommitted))
    return *failed;
  return job.done("the program in RAM is in flash now");
}

Report deliver(Session& session, const Delivery& delivery, BatteryPolicy battery,
               Progress& progress) {
  const auto greeting = greet(session);
  if (!greeting)
    return greeting.error();
  Report report;
  std::string stored;
  const auto several = delivery.macros.size() + (delivery.program ? 1 : 0) > 1;
  const auto done = [&](const std::string& name, Report next) {
    report = std::move(next);
    const auto is_done = report.kind == Report::Kind::Done;
    if (several)
      report.message = fmt::format("{}: {}", name, report.message);
    if (is_done)
      stored += (stored.empty() ? "" : "; ") + report.message;
    else if (!stored.empty())
      report.message += fmt::format(" (before that: {})", stored);
    return is_done;
  };
  for (const auto& macro : delivery.macros) {
    progress.on_item(macro.name);
    if (!done(macro.name, upload(session, macro.job, progress)))
      return report;
  }
  if (delivery.program) {
    progress.on_item(delivery.program_name);
    if (!done(delivery.program_name,
              upload(session, *delivery.program, *greeting, battery, progress)))
      return report;
  }
  report.message = stored;
  return report;
}

Report upload(Session& session, const ProgramJob& job, const Greeting& greeting,
              BatteryPolicy battery, Progress& progress) {
  const auto& budgets = session.budgets();
  const auto plan = make_plan(job, greeting.firmware, budgets, session.next_seq());
  if (!plan)
    return {Report::Kind::Impossible, Content::Unchanged, plan.error().message, 0};
  if (job.area == Area::Flash)
    if (auto low = check_battery(greeting, battery))
      return *low;
  const auto target = plan->route == Route::FlashDirectly ? Area::Flash : Area::Ram;
  Job work(session, progress, plan->route);
  work.status.bytes_total = plan->size;
  work.status.packets_total = plan->pieces;

  auto sent = attempt(work, job.image, target, plan->route);
  for (int number = 2; sent && *sent == Sent::StartOver && number <= budgets.attempts; ++number) {
    if (const auto waited = session.listen(session.now() + budgets.backoff(number - 1)); !waited)
      return work.lost(ApiCommand::AppendOrbbasicFragment, waited.error());
    work.status.attempt = number;
    sent = attempt(work, job.image, target, plan->route);
  }
  if (!sent)
    return sent.error();
  if (*sent == Sent::StartOver)
    return {Report::Kind::LinkLost, work.content,
            fmt::format("gave up after {} attempts: the link loses or doubles too many packets; {}",
                        budgets.attempts, describe(work.content, plan->route)),
            0};

  if (plan->route == Route::RamThenFlash) {
    work.show(Stage::Storing);
    work.content = Content::Unconfirmed;
    if (auto failed = work.ask(ApiCommand::CommitRamToFlash, {}, Content::Uncommitted))
      return *failed;
  }
  work.content = Content::Stored;
  if (job.start_line)
    if (auto failed = start_program(work, job.area, *job.start_line))
      return *failed;
  work.show(Stage::Done);
  return work.done(
      fmt::format("{} bytes in {}", plan->size, job.area == Area::Flash ? "flash" : "RAM"));
}

Report upload(Session& session, const MacroJob& job, Progress& progress) {
  const auto plan = make_plan(job, session.budgets(), session.next_seq());
  if (!plan)
    return {Report::Kind::Impossible, Content::Unchanged, plan.error().message, 0};
  Job work(session, progress, plan->route);
  work.status.bytes_total = plan->size;
  work.status.packets_total = plan->pieces;
  auto image = job.image;
  if (plan->route == Route::TemporaryPacket || plan->route == Route::TemporaryChunks)
    image.id = spec::macro_id_temporary;
  const auto bytes = encode(image);

  work.show(Stage::Preparing);
  if (auto failed = work.ask(ApiCommand::AbortMacro))
    return *failed;
  if (job.clear_others) {
    work.content = Content::ErasedOrUnchanged;
    if (auto failed = work.ask(ApiCommand::ReinitMacroExecutive))
      return *failed;
    work.content = Content::Erased;
  }
  std::optional<Report> failed;
  switch (plan->route) {
  case Route::TemporaryPacket:
    work.show(Stage::Sending);
    work.content = Content::Unconfirmed;
    failed = work.ask(ApiCommand::SaveTemporaryMacro, bytes);
    break;
  case Route::TemporaryChunks: failed = send_chunks(work, bytes); break;
  case Route::UserMacro:
    failed = save_user_macro(work, bytes, job.clear_others ? IdKnown::Free : IdKnown::No);
    break;
  case Route::StreamedMacro: failed = send_stream(work, image); break;
  case Route::Ram:
  case Route::RamThenFlash:
  case Route::FlashDirectly: break; // programs
  }
  if (failed)
    return *failed;
  work.status.bytes_sent = work.status.bytes_total;
  work.status.packets = work.status.packets_total;
  const auto in_pieces =
      plan->route == Route::TemporaryChunks || plan->route == Route::StreamedMacro;
  if (!in_pieces)
    session.watch_duplicates(); // those until now did no harm
  const auto confirmed = barrier(work);
  if (!confirmed)
    return confirmed.error();
  if (*confirmed == Sent::StartOver)
    return {Report::Kind::Unknown, Content::Unconfirmed,
            "a packet was answered twice: the macro on the ball may be damaged; upload again", 0};
  work.content = Content::Stored;
  if (job.run && plan->route != Route::StreamedMacro)
    if (auto not_started = start_macro(work, image.id))
      return *not_started;
  work.show(Stage::Done);
  return work.done(fmt::format("{} bytes as {}", plan->size, to_string(plan->route)));
}

} // namespace orb::uploader
