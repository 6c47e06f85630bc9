#include "uploader/upload.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace orb::uploader {
namespace {

using protocol::LinkError;
using protocol::Response;
using spec::ApiCommand;
using spec::Retry;
using spec::retry_of;

constexpr auto power_state_at = spec::answer_offset(ApiCommand::GetPowerState, "power state");
constexpr auto rx_good_at = spec::answer_offset(ApiCommand::PerformLevel2Diagnostics, "Rx_Good");

bool is_ok(const Response& response) {
  return response.code == static_cast<std::uint8_t>(spec::ResponseCode::Ok);
}

double seconds(Duration duration) {
  return static_cast<double>(duration.count()) / 1e9;
}

bool is_program(Route route) {
  return route == Route::Ram || route == Route::RamThenFlash || route == Route::FlashDirectly;
}

/// `RAM holds part of the program`: what is where, for the end of a message.
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
  case Content::Uncommitted: return "the program is in RAM, the one in flash is unchanged";
  case Content::Unconfirmed:
    return committed ? "the program in flash is the old one or the new one"
                     : fmt::format("whether the program in {} is complete is not known", place);
  case Content::Stored:
    return fmt::format("the program is stored in {}", committed ? "flash" : place);
  }
  return {};
}

bool is_interruption(const NoAnswer& failure) {
  return failure.kind == NoAnswer::Kind::Link && failure.link.kind == LinkError::Kind::Interrupted;
}

Report refused(ApiCommand command, const Response& response, Content content,
               std::string_view state) {
  const auto* row = spec::find_response(response.code);
  return {Report::Kind::Refused, content,
          fmt::format("the ball refused {}: {}{}{}{}", spec::info(command).name,
                      describe_code(response.code), state,
                      row == nullptr || row->remedy.empty() ? "" : "; ",
                      row == nullptr ? "" : row->remedy),
          response.code};
}

/// No answer, or none but "damaged".
Report lost(const Session& session, ApiCommand command, const NoAnswer& failure, Content content,
            std::string_view state) {
  const auto name = spec::info(command).name;
  if (is_interruption(failure))
    return {Report::Kind::Interrupted, content, fmt::format("interrupted{}", state), 0};
  return {content == Content::Unconfirmed ? Report::Kind::Unknown : Report::Kind::LinkLost, content,
          failure.kind == NoAnswer::Kind::Link
              ? fmt::format("link lost during {}: {}{}", name, failure.link.message, state)
              : fmt::format("the ball stopped answering: nothing to {} within {:g} s{}", name,
                            seconds(session.budgets().answer), state),
          0};
}

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

/// Whether a message shows that a program runs, or ran until now.
bool is_sign_of_life(const protocol::Async& message) {
  return message.id == static_cast<std::uint8_t>(spec::AsyncId::BasicPrint) ||
         message.id == static_cast<std::uint8_t>(spec::AsyncId::BasicErrorText) ||
         message.id == static_cast<std::uint8_t>(spec::AsyncId::BasicError);
}

/// Carries a plan out and knows what is on the ball at each moment.
class Upload {
public:
  Upload(Session& session, const Plan& plan, Progress& progress)
      : session_(session), plan_(plan), progress_(progress) {
    status_.bytes_total = plan.size;
    status_.packets_total = plan.pieces;
    status_.expected = plan.expected;
  }

  /// Walks the steps, from the first again where the content may have arrived otherwise than once.
  Report run(std::string done) {
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

private:
  /// What came of a step: a report where the upload ends with it.
  enum class Sent : std::uint8_t { Whole, StartOver };
  using Ended = tl::expected<Sent, Report>;
  using Answer = tl::expected<std::optional<Response>, NoAnswer>;

  Ended carry_out(const Step& step) {
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

  std::optional<Report> begin_again() {
    const auto& budgets = session_.budgets();
    if (status_.attempt == plan_.attempts)
      return Report{Report::Kind::LinkLost, content_,
                    fmt::format("gave up after {} attempts: the link loses or doubles too many "
                                "packets{}",
                                plan_.attempts, state()),
                    0};
    if (const auto waited = session_.listen(session_.now() + budgets.backoff(status_.attempt));
        !waited)
      return lose(ApiCommand::AppendOrbbasicFragment, waited.error());
    ++status_.attempt;
    return std::nullopt;
  }

  // What is told.

  void show(Stage stage) {
    status_.stage = stage;
    progress_.on_status(status_, session_.now());
  }

  std::string state() const { return "; " + describe(content_, plan_.route); }

  Report refuse(ApiCommand command, const Response& response) const {
    return refused(command, response, content_, state());
  }

  Report lose(ApiCommand command, const NoAnswer& failure) const {
    const auto advice = content_ == Content::Unconfirmed ? std::string()
                        : content_ == Content::Stored    ? "; whether it runs is not known"
                                                         : fmt::format("; {}", plan_.again);
    return lost(session_, command, failure, content_, state() + advice);
  }

  // Before the content.

  /// Sends a harmless command until it is answered.
  Ended ask(const Step& step, Content if_refused) {
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

  Ended erase(const Step& step) {
    const auto before = content_;
    if (before == Content::Unchanged)
      content_ = Content::ErasedOrUnchanged;
    auto ended = ask(step, before);
    if (ended)
      content_ = Content::Erased;
    return ended;
  }

  /// How many whole packets the ball says it has received, and how many we know of.
  struct Count {
    std::uint32_t received = 0;
    std::uint32_t arrived = 0;

    bool fits(const Count& later) const {
      return later.received - received == later.arrived - arrived;
    }
  };

  /// Nothing where the ball does not say.
  tl::expected<std::optional<Count>, NoAnswer> ask_count(ApiCommand command) {
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
    return std::nullopt; // silent to this command alone
  }

  Ended count(const Step& step) {
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

  /// Whether the ball has received as many packets as it has answered since it was asked first. The
  /// first time that it has not, it is asked until two counts fit: a ball that counts otherwise
  /// than we do is not asked any more.
  tl::expected<bool, NoAnswer> count_fits(ApiCommand command) {
    constexpr int trials = 7; // on a link that loses and doubles 10 % three pairs in four fit
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

  // The content.

  Ended append(const Step& step) {
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

  /// Sends the next piece, of a stream until the buffer of the ball has room for it.
  Answer offer(const Step& step, std::size_t& sent) {
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

  /// A piece without an answer: what is stored is not known. A program is sent again from the
  /// start; a macro is thrown away, as it may be playing.
  Ended unanswered(ApiCommand command, const Answer& answer) {
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

  /// The report, after a macro that has arrived in part has been aborted.
  Report stopped(Report report) {
    if (!is_program(plan_.route) && session_.ask(ApiCommand::AbortMacro))
      report.message += "; the macro was aborted";
    return report;
  }

  /// Waits until all answers of the ball have come through. A second one among them, or another
  /// number of packets in the ball than were answered, says that a piece may be there twice.
  Ended barrier(const Step& step) {
    show(Stage::Confirming);
    // Where flash is meant, what is in RAM does not matter yet.
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

  Ended doubled() {
    if (!is_program(plan_.route))
      return tl::unexpected(stopped(
          {Report::Kind::Unknown, Content::Unconfirmed,
           "a packet arrived twice: the macro on the ball may be damaged; upload again", 0}));
    content_ = Content::Incomplete;
    return Sent::StartOver;
  }

  Ended store(const Step& step) {
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
    session_.watch_duplicates(); // those until now did no harm
    return ended;
  }

  Ended save_user_macro(const Step& step) {
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
                        "clear all macros of the ball with `--clear-macros`";
      return tl::unexpected(report);
    }
    content_ = Content::Unconfirmed;
    if (!first)
      return tl::unexpected(lose(step.command, first.error()));
    // The answer is lost. Sent again, OK says that the first did not arrive; "exists" says that it
    // did, provided that the id was free.
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

  // After the content.

  Ended start(const Step& step) {
    show(Stage::Starting);
    auto& inbox = session_.inbox();
    if (const auto settled = session_.listen(session_.now() + session_.budgets().settle); !settled)
      return tl::unexpected(lose(step.command, settled.error()));
    inbox.clear(); // what ran before has said its last
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

  /// Whether what was started without an answer shows that it runs.
  bool runs(const Step& step) {
    if (step.command == ApiCommand::RunMacro) {
      const auto status = session_.ask(ApiCommand::GetMacroStatus);
      return status && is_ok(*status) && status->data.front() == step.data.front();
    }
    const auto& inbox = session_.inbox();
    const auto sign = [&] { return std::any_of(inbox.begin(), inbox.end(), is_sign_of_life); };
    return session_.listen(session_.now() + session_.budgets().start_sign, sign) && sign();
  }

  Session& session_;
  const Plan& plan_;
  Progress& progress_;
  Status status_;
  Content content_ = Content::Unchanged;
  std::size_t uncounted_ = 0;   ///< pieces of which only the answers are known
  std::optional<Count> before_; ///< the content
  enum class Trust : std::uint8_t { NotYet, Yes, No } trust_ = Trust::NotYet; ///< in its counting
};

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
    return fmt::format("{}; {} bytes came that are not an answer: the other end is not a ball",
                       tried, counts.bytes_in);
  return tried + "; is the ball awake (shake it), charged and not connected to a phone?";
}

} // namespace

// A piece arrives once with (1−d)(1−q)² or d·2q(1−q)², and twice with one of its answers lost, so
// that it looks like once, with d(1−q)²·2q(1−q); whatever else happens to it starts the upload
// over.
double unseen_bound(std::size_t pieces, double doubled, double lost) {
  const auto arrives = (1 - lost) * (1 - lost);
  const auto once = (1 - doubled) * arrives + doubled * 2 * lost * arrives;
  const auto twice_unseen = doubled * arrives * 2 * lost * (1 - lost);
  return 1 - std::pow(once / (once + twice_unseen), static_cast<double>(pieces));
}

ExitCode exit_code(Report::Kind kind) {
  switch (kind) {
  case Report::Kind::Done: return ExitCode::Done;
  case Report::Kind::Impossible: return ExitCode::BadInput;
  case Report::Kind::Refused: return ExitCode::Refused;
  case Report::Kind::NoBall: return ExitCode::NoBall;
  case Report::Kind::LinkLost: return ExitCode::LinkLost;
  case Report::Kind::Unknown: return ExitCode::Unknown;
  case Report::Kind::Interrupted: return ExitCode::Interrupted;
  }
  return ExitCode::Bug;
}

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
  constexpr std::string_view unchanged = "the ball is unchanged";
  const auto state = fmt::format("; {}", unchanged);
  const auto absent = [&](const NoAnswer& failure) {
    if (is_interruption(failure))
      return tl::unexpected(lost(session, ApiCommand::Ping, failure, Content::Unchanged, state));
    return tl::unexpected(
        Report{Report::Kind::NoBall, Content::Unchanged, no_ball(session, failure), 0});
  };
  if (const auto drained = session.drain(); !drained)
    return absent(drained.error());
  if (const auto pong = session.ask(ApiCommand::Ping); !pong)
    return absent(pong.error());
  Greeting greeting;
  auto versions = request(session, ApiCommand::GetVersioning, {},
                          {std::string(unchanged), std::string(unchanged)});
  if (!versions)
    return tl::unexpected(versions.error());
  greeting.versions = versions->data;
  greeting.firmware = read_capabilities(greeting.versions);
  const auto power = session.ask(ApiCommand::GetPowerState);
  if (!power)
    return tl::unexpected(
        lost(session, ApiCommand::GetPowerState, power.error(), Content::Unchanged, state));
  if (is_ok(*power))
    greeting.power = power->data;
  return greeting;
}

namespace {

/// Whether a command changes nothing about the ball.
bool only_asks(ApiCommand command) {
  const auto name = spec::info(command).name;
  return command == ApiCommand::Ping || name.starts_with("get-") || name.starts_with("poll-");
}

/// What is known of the ball where a command was sent and no answer came.
std::string after_silence(ApiCommand command) {
  if (only_asks(command))
    return "the ball is unchanged";
  return fmt::format("whether the ball has carried out {} is not known{}", spec::info(command).name,
                     spec::info(command).idempotent == spec::Idempotent::Yes
                         ? "; sent again it does no harm"
                         : "");
}

} // namespace

tl::expected<Response, Report> request(Session& session, ApiCommand command, const Bytes& data,
                                       const Known& known) {
  const auto harmless = spec::info(command).idempotent == spec::Idempotent::Yes;
  const auto answer = harmless ? session.ask(command, data) : session.exchange(command, data);
  if (answer && is_ok(*answer))
    return *answer;
  if (answer)
    return tl::unexpected(
        refused(command, *answer, Content::Unchanged,
                known.if_refused.empty() ? std::string() : "; " + known.if_refused));
  auto report = lost(session, command, answer.error(), Content::Unchanged,
                     "; " + (known.if_lost.empty() ? after_silence(command) : known.if_lost));
  if (!harmless && report.kind == Report::Kind::LinkLost)
    report.kind = Report::Kind::Unknown;
  return tl::unexpected(report);
}

std::string bootloader_remedy(std::string_view port) {
  return fmt::format("`orb exec leave-bootloader --port {}` starts the firmware; where that is "
                     "refused, charge the ball and let the vendor's app write its firmware again",
                     port);
}

std::optional<Report> refuse_bootloader(const Greeting& greeting, std::string_view port) {
  if (!greeting.firmware.in_bootloader)
    return std::nullopt;
  return Report{
      Report::Kind::Refused, Content::Unchanged,
      fmt::format("the ball is in its bootloader, where nothing runs; it is unchanged; {}",
                  bootloader_remedy(port)),
      0};
}

Report commit(Session& session, const Greeting& greeting, BatteryPolicy battery) {
  if (auto refused = refuse_bootloader(greeting))
    return *refused;
  if (!greeting.firmware.can_commit)
    return {Report::Kind::Refused, Content::Unchanged,
            "this firmware cannot commit RAM to flash (API 1.47 can); upload with `--area flash`",
            0};
  if (auto low = check_battery(greeting, battery))
    return *low;
  Plan plan;
  plan.route = Route::RamThenFlash;
  plan.again = "commit again";
  plan.steps = {{StepKind::Prepare, ApiCommand::AbortOrbbasicProgram},
                {StepKind::Store, ApiCommand::CommitRamToFlash}};
  NullProgress nobody;
  return Upload(session, plan, nobody).run("the program in RAM is in flash now");
}

Report deliver(Session& session, const Delivery& delivery, BatteryPolicy battery,
               Progress& progress) {
  const auto greeting = greet(session);
  if (!greeting)
    return greeting.error();
  if (auto refused = refuse_bootloader(*greeting, delivery.port))
    return *refused;
  Report report;
  std::string stored;
  const auto several = delivery.macros.size() + (delivery.program ? 1 : 0) > 1;
  const auto done = [&](const std::string& name, Report next) {
    next.uncounted += report.uncounted;
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
  const auto plan = make_plan(job, greeting.firmware, session.budgets());
  if (!plan)
    return {Report::Kind::Impossible, Content::Unchanged, plan.error().message, 0};
  if (job.area == Area::Flash)
    if (auto low = check_battery(greeting, battery))
      return *low;
  return Upload(session, *plan, progress)
      .run(fmt::format("{} bytes in {}", plan->size, job.area == Area::Flash ? "flash" : "RAM"));
}

Report upload(Session& session, const MacroJob& job, Progress& progress) {
  const auto plan = make_plan(job, session.budgets());
  if (!plan)
    return {Report::Kind::Impossible, Content::Unchanged, plan.error().message, 0};
  return Upload(session, *plan, progress)
      .run(fmt::format("{} bytes as {}", plan->size, to_string(plan->route)));
}

} // namespace orb::uploader
