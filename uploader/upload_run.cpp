#include "uploader/upload_run.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::uploader {

using spec::Retry;
using spec::retry_of;

namespace {

constexpr auto rx_good_at = spec::answer_offset(ApiCommand::PerformLevel2Diagnostics, "Rx_Good");

bool is_program(Route route) {
  return route == Route::Ram || route == Route::RamThenFlash || route == Route::FlashDirectly;
}

/// Describes what is stored where, to end a message: `RAM holds part of the program`.
std::string describe(Content content, Route route) {
  const auto committed = route == Route::RamThenFlash;
  const std::string_view place = route == Route::FlashDirectly ? "flash" : "RAM";
  if (!is_program(route)) {
    switch (content) {
    case Content::Unchanged: return "the ball's macros are unchanged";
    case Content::ErasedOrUnchanged: return "the ball's macros may have been cleared";
    case Content::Erased: return "the ball's macros have been cleared";
    case Content::Incomplete: return "the ball may hold a part of the macro";
    case Content::Uncommitted:
    case Content::Unconfirmed: return "the macro may or may not be there";
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
  case Content::Uncommitted: return "the program is in RAM; the one in flash is unchanged";
  case Content::Unconfirmed:
    return committed ? "the program in flash is the old one or the new one"
                     : fmt::format("the program in {} may be incomplete", place);
  case Content::Stored:
    return fmt::format("the program is stored in {}", committed ? "flash" : place);
  }
  return {};
}

/// Meaning of a second answer: a piece stored twice; or nothing, for example after a second start,
/// which the ball refuses.
enum class Duplicates : std::uint8_t { Matter, DoNotMatter };

/// Sends a packet that must be executed exactly once. `data` makes the payload for the next
/// sequence number, so that a repetition can be cut differently. Returns an answer other than OK
/// only if repeating does not help.
template <class MakeData>
tl::expected<std::optional<Response>, NoAnswer>
send_once(Session& session, ApiCommand command, Duplicates duplicates, const MakeData& data) {
  for (int resend = 0; resend <= session.budgets().resends; ++resend) {
    const auto answer = session.exchange(command, data());
    if (!answer && answer.error().kind == NoAnswer::Kind::Link)
      return tl::unexpected(answer.error());
    if (!answer || (duplicates == Duplicates::Matter && session.duplicate_seen()))
      return std::nullopt;
    if (is_transient(answer->code)) {
      if (const auto waited = session.listen(session.now() + session.budgets().backoff(resend + 1));
          !waited)
        return tl::unexpected(waited.error());
    } else if (retry_of(answer->code) != Retry::SameAgain) {
      return *answer;
    }
  }
  return std::nullopt;
}

bool is(const protocol::Async& message, spec::AsyncId id) {
  return message.id == static_cast<std::uint8_t>(id);
}

bool is_error(const protocol::Async& message) {
  return is(message, spec::AsyncId::BasicError);
}

/// Returns true if the message shows that a program runs or has run.
bool is_sign_of_life(const protocol::Async& message) {
  return is_error(message) || is(message, spec::AsyncId::BasicPrint) ||
         is(message, spec::AsyncId::BasicErrorText);
}

} // namespace

tl::expected<void, NoAnswer> await_start(Session& session) {
  const auto& inbox = session.inbox();
  const auto any = [&](bool (*fits)(const protocol::Async&)) {
    return [&inbox, fits] { return std::any_of(inbox.begin(), inbox.end(), fits); };
  };
  const auto& budgets = session.budgets();
  const auto heard = session.listen(session.now() + budgets.start_sign, any(is_sign_of_life));
  if (!heard || !any(is_sign_of_life)())
    return heard;
  return session.listen(session.now() + budgets.start_error, any(is_error));
}

tl::expected<void, NoAnswer> brake(Session& session) {
  const std::pair<ApiCommand, Bytes> steps[] = {
      {ApiCommand::SetRawMotorValues, Bytes(4, 0)}, // switches stabilization off
      {ApiCommand::SetStabilization, {1}},          // without it a roll is ignored
      {ApiCommand::Roll, Bytes(4, 0)}};
  for (const auto& [command, data] : steps)
    if (const auto answer = session.ask(command, data); !answer)
      return tl::unexpected(answer.error());
  return {};
}

Upload::Upload(Session& session, const Plan& plan, Progress& progress)
    : session_(session), plan_(plan), progress_(progress) {
  status_.bytes_total = plan.size;
  status_.packets_total = plan.pieces;
  status_.expected = plan.expected;
}

Report Upload::run(std::string done) {
  for (std::size_t at = 0; at < plan_.steps.size();) {
    const auto ended = carry_out(plan_.steps[at]);
    if (!ended)
      return ended.error();
    ++at;
    if (*ended == Sent::Whole)
      continue;
    if (auto failed = begin_again())
      return *failed;
    at = 0;
  }
  show(Stage::Done);
  return {Report::Kind::Done, Content::Stored, std::move(done), 0, uncounted_};
}

Upload::Ended Upload::carry_out(const Step& step) {
  switch (step.kind) {
  case StepKind::Prepare: show(Stage::Preparing); return ask(step, content_);
  case StepKind::Erase: return erase(step);
  case StepKind::Count: return count(step);
  case StepKind::Append: return append(step);
  case StepKind::Barrier: return barrier(step);
  case StepKind::Store: return store(step);
  case StepKind::Start: return start(step);
  }
  return Sent::Whole;
}

std::optional<Report> Upload::begin_again() {
  const auto& budgets = session_.budgets();
  if (status_.attempt == plan_.attempts)
    return Report{
        Report::Kind::LinkLost, content_,
        fmt::format("gave up after {} attempts: the link loses or duplicates too many packets{}",
                    plan_.attempts, state()),
        0};
  if (const auto waited = session_.listen(session_.now() + budgets.backoff(status_.attempt));
      !waited)
    return lose(ApiCommand::AppendOrbbasicFragment, waited.error());
  ++status_.attempt;
  return std::nullopt;
}

std::string Upload::state() const {
  return "; " + describe(content_, plan_.route);
}

void Upload::show(Stage stage) {
  status_.stage = stage;
  progress_.on_status(status_, session_.now());
}

Report Upload::refuse(ApiCommand command, const Response& response) const {
  return refused(command, response, content_, state());
}

Report Upload::lose(ApiCommand command, const NoAnswer& failure) const {
  const auto advice = content_ == Content::Unconfirmed ? std::string()
                      : content_ == Content::Stored    ? "; it is unknown whether it is running"
                                                       : fmt::format("; {}", plan_.again);
  return lost(session_, command, failure, content_, state() + advice);
}

Upload::Ended Upload::ask(const Step& step, Content if_refused) {
  const auto answer = session_.ask(step.command, step.data);
  if (!answer)
    return tl::unexpected(lose(step.command, answer.error()));
  if (is_ok(*answer))
    return Sent::Whole;
  if (retry_of(answer->code) == Retry::SameAgain)
    return tl::unexpected(lose(step.command, NoAnswer{}));
  content_ = if_refused;
  return tl::unexpected(refuse(step.command, *answer));
}

Upload::Ended Upload::erase(const Step& step) {
  const auto before = content_;
  if (before == Content::Unchanged)
    content_ = Content::ErasedOrUnchanged;
  auto ended = ask(step, before);
  if (ended)
    content_ = Content::Erased;
  return ended;
}

tl::expected<std::optional<Upload::Count>, NoAnswer> Upload::ask_count(ApiCommand command) {
  const auto answer = session_.ask(command);
  if (answer && is_ok(*answer))
    return Count{read_u32(answer->data, rx_good_at),
                 static_cast<std::uint32_t>(session_.counts().arrived)};
  if (answer)
    return std::nullopt;
  if (answer.error().kind == NoAnswer::Kind::Link)
    return tl::unexpected(answer.error());
  if (const auto pong = session_.ask(ApiCommand::Ping); !pong)
    return tl::unexpected(pong.error());
  return std::nullopt; // this command alone is not answered
}

Upload::Ended Upload::count(const Step& step) {
  before_.reset();
  if (trust_ == Trust::No)
    return Sent::Whole;
  const auto count = ask_count(step.command);
  if (!count)
    return tl::unexpected(lose(step.command, count.error()));
  before_ = *count;
  if (!before_)
    trust_ = Trust::No;
  return Sent::Whole;
}

tl::expected<bool, NoAnswer> Upload::count_fits(ApiCommand command) {
  constexpr int trials = 7; // on a link that loses and doubles 10 %, three pairs in four fit
  auto earlier = *before_;
  for (int trial = 0; trial < trials; ++trial) {
    const auto later = ask_count(command);
    if (!later)
      return tl::unexpected(later.error());
    const auto fits = *later && earlier.fits(**later);
    if (fits)
      trust_ = Trust::Yes;
    if (fits || trust_ == Trust::Yes)
      return fits && trial == 0;
    earlier = later->value_or(earlier);
  }
  trust_ = Trust::No;
  return true;
}

Upload::Ended Upload::append(const Step& step) {
  session_.watch_duplicates();
  session_.inbox().clear(); // of what was stopped
  status_.packets = 0;
  for (std::size_t sent = 0; sent < step.content.size(); ++status_.packets) {
    status_.bytes_sent = sent;
    show(Stage::Sending);
    content_ = Content::Incomplete;
    const auto answer = offer(step, sent);
    if (session_.duplicate_seen())
      return doubled();
    if (!answer || !*answer)
      return unanswered(step.command, answer);
    if (retry_of((*answer)->code) == Retry::StartOver && is_program(plan_.route))
      return Sent::StartOver;
    if (!is_ok(**answer))
      return tl::unexpected(stopped(refuse(step.command, **answer)));
  }
  status_.bytes_sent = status_.bytes_total;
  return Sent::Whole;
}

Upload::Answer Upload::offer(const Step& step, std::size_t& sent) {
  const auto& budgets = session_.budgets();
  const auto patience = session_.now() + (step.cuts.empty() ? Duration{} : budgets.stream_room);
  ByteView piece;
  while (true) {
    auto answer = send_once(session_, step.command, Duplicates::Matter, [&] {
      piece = next_piece(step, sent, status_.packets, session_.next_seq());
      return piece_data(step, piece);
    });
    const auto full = answer && *answer && retry_of((*answer)->code) == Retry::Later;
    if (!full || session_.now() >= patience) {
      sent += piece.size();
      return answer;
    }
    if (const auto waited = session_.listen(session_.now() + budgets.stream_pause); !waited)
      return tl::unexpected(waited.error());
  }
}

Upload::Ended Upload::unanswered(ApiCommand command, const Answer& answer) {
  const auto failure = answer ? NoAnswer{} : answer.error();
  if (!is_program(plan_.route)) {
    content_ = Content::Unconfirmed;
    auto report = lose(command, failure);
    const auto link_works = answer || is_interruption(failure);
    return tl::unexpected(link_works ? stopped(std::move(report)) : std::move(report));
  }
  if (!answer)
    return tl::unexpected(lose(command, failure));
  return Sent::StartOver;
}

Report Upload::stopped(Report report) {
  if (!is_program(plan_.route) && session_.ask(ApiCommand::AbortMacro))
    report.message += "; the macro was aborted";
  return report;
}

Upload::Ended Upload::barrier(const Step& step) {
  show(Stage::Confirming);
  // If the target is flash, RAM content does not count yet.
  const auto committed = plan_.route == Route::RamThenFlash;
  content_ = committed ? Content::Incomplete : Content::Unconfirmed;
  if (!before_) {
    if (auto pong = ask({StepKind::Barrier, ApiCommand::Ping}, content_); !pong)
      return pong;
  } else if (const auto fits = count_fits(step.command); !fits) {
    return tl::unexpected(lose(step.command, fits.error()));
  } else if (!*fits) {
    return doubled();
  }
  if (session_.duplicate_seen())
    return doubled();
  const auto counted = before_ && trust_ == Trust::Yes;
  uncounted_ = step.command == ApiCommand::Ping || counted ? 0 : status_.packets;
  content_ = committed ? Content::Uncommitted : Content::Stored;
  return Sent::Whole;
}

Upload::Ended Upload::doubled() {
  if (!is_program(plan_.route))
    return tl::unexpected(
        stopped({Report::Kind::Unknown, Content::Unconfirmed,
                 "a packet arrived twice: the macro on the ball may be damaged; upload again", 0}));
  content_ = Content::Incomplete;
  return Sent::StartOver;
}

Upload::Ended Upload::store(const Step& step) {
  show(step.data.empty() ? Stage::Storing : Stage::Sending);
  const auto before = content_;
  Ended ended = Sent::Whole;
  if (spec::info(step.command).idempotent == spec::Idempotent::Yes) {
    content_ = Content::Unconfirmed;
    ended = ask(step, before);
  } else {
    ended = save_user_macro(step);
  }
  if (ended)
    content_ = Content::Stored;
  status_.bytes_sent = status_.bytes_total;
  status_.packets = status_.packets_total;
  session_.watch_duplicates(); // earlier duplicates were harmless
  return ended;
}

Upload::Ended Upload::save_user_macro(const Step& step) {
  const auto id_was_free = content_ == Content::Erased;
  const auto save = [&] {
    return send_once(session_, step.command, Duplicates::DoNotMatter, [&] { return step.data; });
  };
  const auto first = save();
  if (first && *first) {
    if (is_ok(**first))
      return Sent::Whole;
    auto report = refuse(step.command, **first);
    report.message += ". An id that is in use cannot be replaced: choose another with `--id`, or "
                      "clear all macros on the ball with `--clear-macros`";
    return tl::unexpected(report);
  }
  content_ = Content::Unconfirmed;
  if (!first)
    return tl::unexpected(lose(step.command, first.error()));
  // The answer is lost. On repeating, OK means that the first did not arrive; "exists" means that
  // it did, provided the id was free.
  const auto second = save();
  const auto exists = second && *second && retry_of((*second)->code) == Retry::Later;
  if ((second && *second && is_ok(**second)) || (exists && id_was_free))
    return Sent::Whole;
  auto report = lose(step.command, second ? NoAnswer{} : second.error());
  if (exists)
    report.message = "the answer to save-macro was lost; the ball now has a macro with this id, "
                     "probably this one";
  return tl::unexpected(report);
}

Upload::Ended Upload::start(const Step& step) {
  show(Stage::Starting);
  auto& inbox = session_.inbox();
  if (const auto settled = session_.listen(session_.now() + session_.budgets().settle); !settled)
    return tl::unexpected(lose(step.command, settled.error()));
  inbox.clear(); // what ran before sends no more
  const auto answer =
      send_once(session_, step.command, Duplicates::DoNotMatter, [&] { return step.data; });
  if (answer && *answer && is_ok(**answer))
    return Sent::Whole;
  if (answer && *answer)
    return tl::unexpected(refuse(step.command, **answer));
  if (!answer && is_interruption(answer.error()))
    return tl::unexpected(lose(step.command, answer.error()));
  if (answer && runs(step))
    return Sent::Whole;
  return tl::unexpected(
      Report{Report::Kind::Unknown, Content::Stored,
             fmt::format("stored, start not confirmed: {}; the {} is stored and may be running",
                         answer ? "the ball did not answer" : answer.error().link.message,
                         is_program(plan_.route) ? "program" : "macro"),
             0});
}

bool Upload::runs(const Step& step) {
  if (step.command == ApiCommand::RunMacro) {
    const auto status = session_.ask(ApiCommand::GetMacroStatus);
    return status && is_ok(*status) && status->data.front() == step.data.front();
  }
  const auto& inbox = session_.inbox();
  return await_start(session_) && std::any_of(inbox.begin(), inbox.end(), is_sign_of_life);
}

} // namespace orb::uploader
