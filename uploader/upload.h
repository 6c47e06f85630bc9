#pragma once

#include "base/exit_code.h"
#include "uploader/plan.h"
#include "uploader/session.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::uploader {

/// What the target of an upload now contains.
enum class Content : std::uint8_t {
  Unchanged,
  ErasedOrUnchanged, ///< the erase was sent, its answer is missing
  Erased,
  Incomplete,  ///< a front part of the program or macro, perhaps all of it
  Uncommitted, ///< RAM holds the program, flash is unchanged
  Unconfirmed, ///< all of it was sent, but its arrival is unconfirmed
  Stored
};

/// The result of an upload. Only Done is success.
struct Report {
  enum class Kind : std::uint8_t {
    Done,
    Impossible, ///< it cannot fit this ball; nothing was changed
    Refused,    ///< the ball refused, or its battery is too low
    NoBall,     ///< nothing answered like a ball
    LinkLost,   ///< the link failed or the ball stopped answering; `content` is what is known
    Unknown,    ///< it may have worked: neither success nor failure
    Interrupted ///< by the user
  };
  Kind kind = Kind::Done;
  Content content = Content::Unchanged;
  std::string message;   ///< one sentence: what happened, what is on the ball, what helps
  std::uint8_t code = 0; ///< of Refused, if the ball gave one
  /// Pieces acknowledged by a ball that does not count received packets: see unseen_bound().
  std::size_t uncounted = 0;
};

/// Returns the greatest share of uploads that look right but are wrong, over a link that delivers a
/// share `doubled` of commands twice and loses a share `lost` of packets in each direction, to a
/// ball that does not count received packets: one of `pieces` came twice, and one of its answers
/// was lost. A link that doubles nothing gives 0.
double unseen_bound(std::size_t pieces, double doubled, double lost);

/// Returns the exit code for a report.
ExitCode exit_code(Report::Kind kind);

/// What a ball reported before anything was changed.
struct Greeting {
  Bytes versions;
  Capabilities firmware;
  std::optional<Bytes> power; ///< the answer of Get Power State, if the ball gave one

  /// The power state of the API; 0 if unknown.
  std::uint8_t power_state() const;
};

enum class Stage : std::uint8_t {
  Greeting,
  Preparing,
  Sending,
  Confirming,
  Storing,
  Starting,
  Done
};
std::string_view to_string(Stage stage);

/// The progress of an upload.
struct Status {
  Stage stage = Stage::Greeting;
  std::size_t bytes_sent = 0; ///< of the program or macro, acknowledged
  std::size_t bytes_total = 0;
  std::size_t packets = 0;       ///< content packets acknowledged
  std::size_t packets_total = 0; ///< planned; resends and short fragments add to it
  int attempt = 1;
  Duration expected{}; ///< estimated total time, if known
};

/// Receives the progress of an upload.
class Progress {
public:
  virtual ~Progress() = default;
  /// The next of several items begins.
  virtual void on_item(std::string_view name) = 0;
  virtual void on_status(const Status& status, Instant now) = 0;
};

/// For callers that show no progress.
class NullProgress final : public Progress {
public:
  void on_item(std::string_view) override {}
  void on_status(const Status&, Instant) override {}
};

/// Refuse: a nearly empty battery forbids flash writes.
enum class BatteryPolicy : std::uint8_t { Refuse, Ignore };

/// Returns `firmware 0.98, orbBasic 0.9, macro executive 2`.
std::string describe_firmware(const Greeting& greeting);

/// Discards stray bytes, pings until there is an answer, asks for versions and power.
tl::expected<Greeting, Report> greet(Session& session);

/// Returns what helps a ball in its bootloader: it was sent there, or its update was interrupted
/// (REC; the vendor's support advice for a ball that flashes red).
std::string bootloader_remedy(std::string_view port = "…");

/// Returns why a ball takes neither programs nor macros if it is in its bootloader; otherwise
/// nullopt.
std::optional<Report> refuse_bootloader(const Greeting& greeting, std::string_view port = "…");

/// Uploads a program and reports what is certain (docs/using/uploading.md). Ends before the plan's
/// deadline.
Report upload(Session& session, const ProgramJob& job, const Greeting& greeting,
              BatteryPolicy battery, Progress& progress);

/// Uploads a macro likewise.
Report upload(Session& session, const MacroJob& job, Progress& progress);

/// Everything for one ball: macros first, then the program.
struct Delivery {
  struct NamedMacro {
    std::string name; ///< for messages
    MacroJob job;
  };
  std::vector<NamedMacro> macros;
  std::string program_name;
  std::optional<ProgramJob> program;
  std::string port = "…"; ///< as named by the user, for messages
  /// Returns why this ball should not get it, as a sentence; nothing is changed then.
  std::function<std::optional<std::string>(const Greeting&)> misfit = {};
};

/// Greets the ball and uploads everything, up to the first item that is not Done. Refuses
/// foreseeable problems before anything is sent. With several items the message names the one
/// concerned.
Report deliver(Session& session, const Delivery& delivery, BatteryPolicy battery,
               Progress& progress);

/// Waits for the first output of a started program: an error, or a print and whatever follows at
/// once; at most Budgets::start_sign. Messages stay in the inbox.
tl::expected<void, NoAnswer> await_start(Session& session);

/// Stops the wheels, whatever drives them. A program that stops with an error leaves them turning.
tl::expected<void, NoAnswer> brake(Session& session);

/// Stops what runs and commits the RAM program to flash.
Report commit(Session& session, const Greeting& greeting, BatteryPolicy battery);

/// What is known about the ball after a failed command, to end a message.
struct Known {
  std::string if_lost; ///< lost or interrupted; empty: what holds for any such command
  std::string if_refused{};
};

/// Sends one command and describes the result. Repeats it until answered if that is harmless;
/// otherwise sends once.
tl::expected<protocol::Response, Report> request(Session& session, spec::ApiCommand command,
                                                 const Bytes& data = {}, const Known& known = {});

} // namespace orb::uploader
