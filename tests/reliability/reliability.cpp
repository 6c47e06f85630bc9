// Uploads over bad links, many times and in virtual time, and compares each report with the ball.
// Prints tables; exits with 1 if a report was wrong, or if uploads hung or failed too often.
//
//   reliability [--uploads N] [--ble N] [--document FILE]
//
// N uploads per fault profile (default 1000, and as many over Bluetooth LE); the other parts do not
// depend on N. --document replaces the first sections of docs/inside/reliability.md.

#include "compiler/load.h"
#include "protocol/link_faults.h"
#include "tests/fakes/gatt_ball.h"
#include "uploader/ble.h"
#include "uploader/upload.h"
#include "vm/ball.h"
#include "vm/ball_transport.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

namespace {

using namespace orb;
using protocol::FaultPlan;
using uploader::Area;
using uploader::Content;
using uploader::ProgramJob;
using uploader::Report;
using Kind = uploader::Report::Kind;

/// The previous program, which distinguishes "unchanged" from "erased".
constexpr std::string_view old_program = "10 print \"old\"\n";
constexpr Duration round_trip = 10ms;

/// Returns a program of `lines` lines of about `width` bytes, with its final NUL.
Bytes program_of(int lines, std::size_t width) {
  std::string text;
  for (int i = 1; i <= lines; ++i) {
    auto line = fmt::format("{} print \"line {}", i * 10, i);
    line.resize(std::max(line.size(), width - 2), '.');
    text += line + "\"\n";
  }
  Bytes image(text.begin(), text.end());
  image.push_back(0);
  return image;
}

constexpr int sixty_lines = 60;
constexpr std::size_t program_pieces = 5; ///< of the upload
constexpr std::size_t line_width = 19;

ByteView bytes_of(std::string_view text) {
  return as_bytes(text);
}

/// If the ball reports how many packets it received. Recorded balls do not.
enum class Counting : std::uint8_t { Refused, Reported };

/// Returns a ball with old programs in both areas.
std::unique_ptr<vm::Ball> make_ball(std::uint64_t seed, Counting counting = Counting::Refused,
                                    std::size_t ram_bytes = 4096,
                                    vm::Observer* observer = nullptr) {
  vm::BallOptions options;
  options.seed = seed;
  options.firmware =
      counting == Counting::Reported ? spec::Firmware::Sphero351 : spec::Firmware::Sphero373;
  options.loader = compiler::load;
  options.ram_bytes = ram_bytes;
  options.observer = observer;
  auto ball = std::make_unique<vm::Ball>(options);
  for (const auto area : {vm::Area::Ram, vm::Area::Flash})
    (void)ball->append_basic(area, bytes_of(old_program));
  return ball;
}

std::unique_ptr<protocol::Transport> connect(vm::Ball& ball, const FaultPlan& plan) {
  return std::make_unique<protocol::FaultTransport>(
      std::make_unique<vm::BallTransport>(ball, vm::WireModel{round_trip}), plan);
}

struct Run {
  Report report;
  Duration took{};
  Duration deadline{};
};

Run upload_once(protocol::Transport& link, const ProgramJob& job, std::uint8_t first_seq,
                const uploader::Budgets& budgets = {}) {
  uploader::Session session(link, budgets, first_seq);
  uploader::NullProgress progress;
  const auto start = session.now();
  uploader::Delivery delivery;
  delivery.program = job;
  Run run;
  run.report = deliver(session, delivery, uploader::BatteryPolicy::Refuse, progress);
  run.took = session.now() - start;
  run.deadline = make_plan(job, uploader::default_capabilities(), budgets)->deadline;
  return run;
}

/// True if the report describes the ball correctly.
bool is_true(const Report& report, const vm::Ball& ball, const ProgramJob& job) {
  const std::string_view image = as_text(job.image);
  const auto area = job.area == Area::Flash ? vm::Area::Flash : vm::Area::Ram;
  const auto ram = ball.basic_text(vm::Area::Ram);
  const auto text = ball.basic_text(area);
  if (report.kind == Kind::Done)
    return text == image;
  const auto kept = job.area == Area::Ram || ball.basic_text(vm::Area::Flash) == old_program;
  switch (report.content) {
  case Content::Unchanged: return text == old_program && ram == old_program;
  case Content::ErasedOrUnchanged: return (ram.empty() || ram == old_program) && kept;
  case Content::Erased: return ram.empty() && kept;
  case Content::Incomplete: return kept;
  case Content::Uncommitted: return ram == image && kept;
  case Content::Unconfirmed: return text == image || text == old_program || job.area == Area::Ram;
  case Content::Stored: return text == image;
  }
  return false;
}

struct Tally {
  int runs = 0;
  int done = 0;
  int reported = 0;
  int wrong = 0;   ///< reported success, other content
  int untrue = 0;  ///< a failure whose description does not fit the ball
  int overdue = 0; ///< beyond the deadline of the plan
  Duration longest{};

  void add(const Run& run, const vm::Ball& ball, const ProgramJob& job) {
    add(run, is_true(run.report, ball, job));
  }
  void add(const Run& run, bool right) {
    ++runs;
    if (run.report.kind == Kind::Done)
      ++(right ? done : wrong);
    else
      ++(right ? reported : untrue);
    if (run.took > run.deadline)
      ++overdue;
    longest = std::max(longest, run.took);
  }
  void add(const Tally& other) {
    runs += other.runs;
    done += other.done;
    reported += other.reported;
    wrong += other.wrong;
    untrue += other.untrue;
    overdue += other.overdue;
    longest = std::max(longest, other.longest);
  }
  bool honest() const { return wrong == 0 && untrue == 0 && overdue == 0; }
};

double seconds(Duration duration) {
  return static_cast<double>(duration.count()) / 1e9;
}

struct Profile {
  std::string_view plan;
  double least_success;       ///< 0: none required
  std::string_view sphero_js; ///< of 2000 runs, if measured
  std::string_view sphero_pwn;
};

constexpr std::string_view not_measured = "–";

constexpr auto profiles = std::to_array<Profile>({
    {"drop=1%", 0.999, "1752 ok, 248 reported", "1752 ok, **248 hang**"},
    {"dup=1%", 0.999, "1903 ok, **97 wrong**", "1903 ok, **97 wrong**"},
    {"flip=1%", 0.999, "1776 ok, 129 reported, **95 wrong**",
     "1764 ok, 108 reported, **128 hang**"},
    {"drop=2%,dup=1%,flip=2%", 0.999, "1172 ok, 630 reported, **198 wrong**",
     "1154 ok, 171 reported, **611 hang, 64 wrong**"},
    {"drop=10%", 0.98, not_measured, not_measured},
    {"dup=10%", 0.98, not_measured, not_measured},
    {"flip=10%", 0.98, not_measured, not_measured},
    {"drop=4%,dup=2%,flip=4%", 0.98, not_measured, not_measured},
    {"delay=50..300ms,drop=1%", 0.999, not_measured, not_measured},
    {"split,flip=1%", 0.999, not_measured, not_measured},
    {"merge,stale=8,dup=1%", 0.999, not_measured, not_measured},
    {"storm=30%,drop=1%,flip=1%", 0.999, not_measured, not_measured},
});

/// Requests that arrive twice. Without other faults the second answer always reveals them.
constexpr auto doubled_requests = std::to_array<std::string_view>(
    {"dup-request=1%", "dup-request=1%,drop=1%", "dup-request=10%,drop=10%"});

ProgramJob job_for(std::uint64_t seed) {
  return {program_of(sixty_lines, line_width), seed % 2 == 0 ? Area::Ram : Area::Flash, {}};
}

Tally run_profile(std::string_view words, int uploads, Counting counting = Counting::Refused) {
  auto plan = *protocol::parse_fault_plan(words);
  Tally tally;
  for (int i = 1; i <= uploads; ++i) {
    plan.seed = static_cast<std::uint64_t>(i);
    const auto job = job_for(plan.seed);
    const auto ball = make_ball(plan.seed, counting);
    const auto link = connect(*ball, plan);
    const auto first_seq = static_cast<std::uint8_t>(Random{plan.seed * 7919}.next());
    tally.add(upload_once(*link, job, first_seq), *ball, job);
  }
  return tally;
}

/// Uploads over a fake GATT: packets in pieces of 20 bytes, notifications of 1 to 20. The faults of
/// `words` affect packets, those of `gatt` pieces.
auto over_ble(std::unique_ptr<protocol::Transport> link, protocol::BleFaultPlan gatt) {
  constexpr Duration piece_interval = 30ms;
  gatt.pieces_least = 1;
  return uploader::open_ble(std::make_unique<test::GattBall>(std::move(link), gatt, piece_interval),
                            uploader::ble_budgets({}), [] { return 0; }, {});
}

Tally run_ble(std::string_view words, protocol::BleFaultPlan gatt, int uploads) {
  auto plan = words.empty() ? FaultPlan{} : *protocol::parse_fault_plan(words);
  const auto budgets = uploader::ble_budgets({});
  Tally tally;
  for (int i = 1; i <= uploads; ++i) {
    plan.seed = gatt.seed = static_cast<std::uint64_t>(i);
    const auto job = job_for(plan.seed);
    const auto ball = make_ball(plan.seed);
    auto link = over_ble(connect(*ball, plan), gatt);
    const auto first_seq = static_cast<std::uint8_t>(Random{plan.seed * 7919}.next());
    if (link)
      tally.add(upload_once(**link, job, first_seq, budgets), *ball, job);
    else
      tally.add({{Report::Kind::NoBall, Content::Unchanged, {}, 0}, {}, {}}, *ball, job);
  }
  return tally;
}

/// Returns the counts other than 0 in words.
std::string tally_cells(const Tally& tally) {
  std::string cells;
  for (const auto& [count, what] :
       {std::pair{tally.done, "ok"}, std::pair{tally.reported, "reported"},
        std::pair{tally.wrong + tally.untrue, "wrong"}})
    if (count > 0)
      cells += fmt::format("{}{} {}", cells.empty() ? "" : ", ", count, what);
  return cells;
}

/// Prints each part and collects the document.
struct Page {
  std::string text;
  bool failed = false;

  void add(const std::string& lines) {
    std::fputs(lines.c_str(), stdout);
    std::fflush(stdout);
    text += lines;
  }
  void check(bool good, const std::string& what) {
    if (good)
      return;
    failed = true;
    std::fprintf(stderr, "FAILED: %s\n", what.c_str());
  }
};

void add_profiles(Page& page, int uploads, int ble_uploads) {
  page.add(fmt::format(R"(## Fault profiles

{} uploads each of a {}-line program ({} bytes, 5 fragments), seeds 1 to {}; every other one into flash through RAM.
Over Bluetooth LE the same packets travel in [pieces](#bluetooth-le).

| profile | orb | longest | orb over Bluetooth LE | longest | sphero.js 0.9.2 | sphero-pwn 0.5.3 |
|---|---|---|---|---|---|---|
)",
                       uploads, sixty_lines, job_for(1).image.size(), uploads));
  for (const auto& profile : profiles) {
    const auto tally = run_profile(profile.plan, uploads);
    const auto success = static_cast<double>(tally.done) / tally.runs;
    const auto ble = run_ble(profile.plan, {}, ble_uploads);
    page.add(fmt::format("| `{}` | {} | {:.1f} s | {} | {:.1f} s | {} | {} |\n", profile.plan,
                         tally_cells(tally), seconds(tally.longest), tally_cells(ble),
                         seconds(ble.longest), profile.sphero_js, profile.sphero_pwn));
    page.check(ble.honest() && ble.done >= profile.least_success * ble.runs - 1,
               fmt::format("{} over Bluetooth LE: {}, {} overdue", profile.plan, tally_cells(ble),
                           ble.overdue));
    page.check(tally.honest(), fmt::format("{}: {} wrong, {} untrue, {} overdue", profile.plan,
                                           tally.wrong, tally.untrue, tally.overdue));
    page.check(success >= profile.least_success,
               fmt::format("{}: {:.3f} % success", profile.plan, success * 100));
  }
  page.add(fmt::format(
      "\nNo upload exceeded the deadline of its plan, {:.0f} s.\n\n",
      seconds(
          make_plan(job_for(2), uploader::default_capabilities(), uploader::Budgets{})->deadline)));
}

/// Faults of pieces alone.
constexpr auto ble_profiles = std::to_array<std::string_view>(
    {"lose=0%", "lose=1%", "lose=5%", "refuse=0.1%", "refuse=1%", "lose=1%,refuse=1%"});
constexpr auto drop_profiles = std::to_array<std::string_view>(
    {"drop-once@connect", "drop-once@services", "drop-once@anti-dos", "drop-once@tx-power",
     "drop-once@wake", "drop-once@subscribe"});

void add_ble(Page& page, int uploads) {
  page.add(fmt::format(R"(## Bluetooth LE

The same program, {} uploads each, through all of orb but D-Bus ([see there](#over-d-bus)): a fake of the robot's
characteristics replaces BlueZ, so time is virtual. Written pieces have 20 bytes and are acknowledged after 30 ms;
notifications have 1 to 20 bytes. The faults are [those of
`orb ball`](../using/uploading.md#virtual-robots-over-bluetooth-le).

| profile | orb | longest |
|---|---|---|
)",
                       uploads));
  const auto measure_profile = [&](std::string_view words) {
    auto tally = run_ble({}, *protocol::parse_ble_fault_plan(words), uploads);
    page.check(tally.honest(),
               fmt::format("{}: {}, {} overdue", words, tally_cells(tally), tally.overdue));
    return tally;
  };
  for (const auto words : ble_profiles) {
    const auto tally = measure_profile(words);
    page.add(fmt::format("| `{}` | {} | {:.1f} s |\n", words, tally_cells(tally),
                         seconds(tally.longest)));
  }
  Tally drops;
  for (const auto words : drop_profiles)
    drops.add(measure_profile(words));
  page.add(fmt::format("| `drop-once@` each of the {} steps | {} | {:.1f} s |\n",
                       drop_profiles.size(), tally_cells(drops), seconds(drops.longest)));
  page.add(fmt::format(
      "\nNo upload exceeded the deadline of its plan, {:.0f} s.\n\n",
      seconds(make_plan(job_for(2), uploader::default_capabilities(), uploader::ble_budgets({}))
                  ->deadline)));
}

/// Records the markers of a macro.
struct Markers final : vm::Observer {
  void on_event(Instant, const vm::Event& event) override {
    if (const auto* marker = std::get_if<vm::event::Marker>(&event))
      seen.push_back(static_cast<std::uint8_t>(marker->marker));
  }
  Bytes seen;
};

/// A macro of markers. As a temporary macro the stored bytes are compared, as a stream the played
/// markers.
constexpr std::size_t macro_pieces = 4;

Tally run_macros(std::string_view words, int uploads, uploader::MacroKind kind, Counting counting) {
  constexpr std::size_t markers = 480; // 960 bytes: as many chunks or pieces
  uploader::MacroJob job;
  job.kind = kind;
  job.image.id = spec::macro_id_temporary;
  Bytes played;
  for (std::size_t i = 0; i < markers; ++i) {
    played.push_back(static_cast<std::uint8_t>(i));
    protocol::append_macro_command(job.image.body, spec::MacroCommand::Marker,
                                   std::array{static_cast<std::int32_t>(played.back())});
  }
  if (kind == uploader::MacroKind::Temporary)
    protocol::append_macro_command(job.image.body, spec::MacroCommand::End, {});
  auto plan = *protocol::parse_fault_plan(words);
  Tally tally;
  for (int i = 1; i <= uploads; ++i) {
    plan.seed = static_cast<std::uint64_t>(i);
    Markers observer;
    const auto ball = make_ball(plan.seed, counting, 4096, &observer);
    const auto link = connect(*ball, plan);
    uploader::Session session(*link, uploader::Budgets{}, static_cast<std::uint8_t>(i));
    uploader::NullProgress progress;
    uploader::Delivery delivery;
    delivery.macros.push_back({"macro", job});
    const auto start = session.now();
    const auto report = deliver(session, delivery, uploader::BatteryPolicy::Refuse, progress);
    const auto arrived =
        kind == uploader::MacroKind::Stream
            ? observer.seen == played
            : std::ranges::equal(ball->macros().store().find(spec::macro_id_temporary),
                                 encode(job.image));
    tally.add({report, session.now() - start, make_plan(job, uploader::Budgets{})->deadline},
              arrived || report.kind != Kind::Done);
  }
  return tally;
}

void add_doubled_requests(Page& page, int uploads) {
  page.add(R"(## Duplicate requests

If a link delivers a *request* twice and loses the second answer, no answer shows the duplicate, and the ball's memory
cannot be read. `orb upload` then gives an upper bound on wrong successes, 1 − (1 − r)^pieces, where r is the share of
duplicate pieces with one answer among those that look right. If a ball that [counts
packets](../reference/links.md#what-an-upload-sends) received more than it answered, orb resends a program, and aborts a macro
and reports it as unknown.

| profile | the ball counts | program, 5 pieces | bound | macro in 4 chunks | macro streamed in 4 pieces | bound |
|---|---|---|---|---|---|---|
)");
  for (const auto words : doubled_requests)
    for (const auto counting : {Counting::Refused, Counting::Reported}) {
      const auto plan = *protocol::parse_fault_plan(words);
      const auto tells = counting == Counting::Reported;
      const auto bound = [&](std::size_t pieces) {
        return tells ? 0 : uploader::unseen_bound(pieces, plan.dup_request, plan.drop);
      };
      const std::pair<Tally, std::size_t> runs[] = {
          {run_profile(words, uploads, counting), program_pieces},
          {run_macros(words, uploads, uploader::MacroKind::Temporary, counting), macro_pieces},
          {run_macros(words, uploads, uploader::MacroKind::Stream, counting), macro_pieces}};
      page.add(fmt::format("| `{}` | {} | {} | {:.2f} % | {} | {} | {:.2f} % |\n", words,
                           tells ? "yes" : "no", tally_cells(runs[0].first),
                           bound(program_pieces) * 100, tally_cells(runs[1].first),
                           tally_cells(runs[2].first), bound(macro_pieces) * 100));
      for (const auto& [tally, pieces] : runs) {
        const auto expected = bound(pieces) * tally.runs;
        page.check(tally.overdue == 0 &&
                       tally.wrong + tally.untrue <= expected + 3 * std::sqrt(expected),
                   fmt::format("{}: {} wrong, {} untrue, {} overdue", words, tally.wrong,
                               tally.untrue, tally.overdue));
      }
    }
  page.add("\n");
}

/// Returns the bytes that an upload without faults sends and receives.
struct Traffic {
  std::uint64_t to_ball = 0;
  std::uint64_t from_ball = 0;
};

Traffic measure(const ProgramJob& job) {
  const auto ball = make_ball(1);
  const auto link = connect(*ball, {});
  uploader::Session session(*link, uploader::Budgets{}, 0);
  uploader::NullProgress progress;
  uploader::Delivery delivery;
  delivery.program = job;
  (void)deliver(session, delivery, uploader::BatteryPolicy::Refuse, progress);
  return {session.counts().bytes_out, session.counts().bytes_in};
}

void add_flips(Page& page) {
  const ProgramJob job{program_of(sixty_lines, 20), Area::Ram, {}};
  const auto traffic = measure(job);
  page.add(fmt::format(R"(## Every single bit

Each bit of a {}-byte upload in turn is inverted.

| direction | result |
|---|---|
)",
                       job.image.size()));
  for (const bool to_ball : {true, false}) {
    Tally tally;
    for (std::uint64_t bit = 0; bit < 8 * (to_ball ? traffic.to_ball : traffic.from_ball); ++bit) {
      FaultPlan plan;
      (to_ball ? plan.flip_at : plan.flip_answer_at) = bit;
      const auto ball = make_ball(1);
      const auto link = connect(*ball, plan);
      tally.add(upload_once(*link, job, 0), *ball, job);
    }
    page.add(fmt::format("| {} the ball | {} |\n", to_ball ? "to" : "from", tally_cells(tally)));
    page.check(tally.honest() && tally.done == tally.runs, "single bits");
  }
  page.add("\n");
}

/// Cuts the link after each byte of one direction, then uploads again over a new one.
void add_cuts(Page& page, const ProgramJob& job, bool to_ball, bool ble) {
  const auto traffic = measure(job);
  const auto budgets = ble ? uploader::ble_budgets({}) : uploader::Budgets{};
  const auto open = [&](vm::Ball& ball, const FaultPlan& plan) {
    return ble ? *over_ble(connect(ball, plan), {}) : connect(ball, plan);
  };
  Tally first;
  Tally second;
  for (std::uint64_t byte = 0; byte <= (to_ball ? traffic.to_ball : traffic.from_ball); ++byte) {
    FaultPlan plan;
    (to_ball ? plan.cut : plan.cut_answer) = byte;
    const auto ball = make_ball(1);
    first.add(upload_once(*open(*ball, plan), job, 0, budgets), *ball, job);
    second.add(upload_once(*open(*ball, {}), job, 0x99, budgets), *ball, job);
  }
  page.add(fmt::format("| {} | {} the ball | {} | {} | {} |\n", ble ? "Bluetooth LE" : "stream",
                       to_ball ? "to" : "from", job.area == Area::Ram ? "RAM" : "flash",
                       tally_cells(first), tally_cells(second)));
  page.check(first.honest() && second.honest() && second.done == second.runs, "cuts");
}

void add_cuts(Page& page) {
  page.add(R"(## Cut after every byte

The link breaks after each byte in turn; the report is compared with the ball, then the program is uploaded again over a
new link.

| link | direction | area | first report | second upload |
|---|---|---|---|---|
)");
  for (const bool ble : {false, true})
    for (const auto area : {Area::Ram, Area::Flash})
      for (const bool to_ball : {true, false})
        add_cuts(page, {program_of(sixty_lines, line_width), area, {}}, to_ball, ble);
  page.add("\n");
}

void add_full_storage(Page& page) {
  constexpr int runs = 50;
  int refused = 0;
  for (int i = 1; i <= runs; ++i) {
    constexpr std::size_t too_small = 600; // bytes, although the ball reports 4096
    const auto ball = make_ball(static_cast<std::uint64_t>(i), Counting::Refused, too_small);
    const auto link = connect(*ball, {});
    const ProgramJob job{program_of(sixty_lines, line_width), Area::Ram, {}};
    const auto run = upload_once(*link, job, static_cast<std::uint8_t>(i));
    refused += run.report.kind == Kind::Refused && run.report.code == 8;
  }
  page.add(fmt::format(R"(## Storage full

Of {0} uploads orb reports {1} as refused, with the reason (exit 5); sphero-pwn 0.5.3 reports 50, sphero.js 0.9.2
gets **50 wrong**.

)",
                       runs, refused));
  page.check(refused == runs, "storage full");
}

/// Records when the first fragment is sent and when the last answer before the barrier arrives.
class Clock final : public uploader::Progress {
public:
  void on_item(std::string_view) override {}
  void on_status(const uploader::Status& status, Instant now) override {
    if (status.stage == uploader::Stage::Sending && !first)
      first = now;
    if (status.stage == uploader::Stage::Confirming)
      last = now;
    packets = status.packets;
  }
  std::optional<Instant> first;
  Instant last{};
  std::size_t packets = 0;
};

void add_speed(Page& page) {
  ProgramJob job;
  for (int lines = 1; program_of(lines, line_width).size() <= 4096; ++lines)
    job.image = program_of(lines, line_width);
  const auto ball = make_ball(1);
  const auto link = connect(*ball, {});
  uploader::Session session(*link, uploader::Budgets{}, 0);
  const auto start = session.now();
  const auto greeting = greet(session);
  Clock clock;
  const auto report = upload(session, job, *greeting, uploader::BatteryPolicy::Refuse, clock);
  const auto all = session.now() - start;
  page.check(report.kind == Kind::Done, "speed: " + report.message);
  const auto took = clock.last - *clock.first;
  // A fragment's packet carries start bytes, DID, CID, SEQ, DLEN, area and checksum; its answer has
  // six bytes. Both travel at the speed of the wire, and one round trip lies between.
  constexpr std::size_t around_a_fragment = 8;
  constexpr std::size_t answer_bytes = 6;
  const auto bytes = job.image.size() + clock.packets * (around_a_fragment + answer_bytes);
  const auto needed = Duration(1s) * static_cast<Duration::rep>(bytes) / 11520 +
                      round_trip * static_cast<Duration::rep>(clock.packets);
  const auto ratio = seconds(took) / seconds(needed);
  page.add(fmt::format(
      R"(## Speed

On a link with {:g} ms round trip and 11 520 bytes/s a program of {} bytes in {} fragments takes {:.3f} s from the first
byte of the first fragment to the last answer; its bytes and one round trip per fragment need {:.3f} s: **{:.3f}×**. The
rest of the upload takes {:.3f} s (200 ms of draining, {} more packets).

)",
      seconds(round_trip) * 1000, job.image.size(), clock.packets, seconds(took), seconds(needed),
      ratio, seconds(all - took), session.counts().packets_out - clock.packets));
  page.check(ratio <= 1.05, fmt::format("speed: {:.3f} of what is needed", ratio));
}

/// Replaces the beginning of the document, up to the sections of other tools.
void write(const std::string& document, const std::string& text) {
  std::ostringstream before;
  before << std::ifstream(document, std::ios::binary).rdbuf();
  const auto others = before.str().find("\n## Writes that fail");
  std::ofstream(document, std::ios::binary)
      << text << (others == std::string::npos ? std::string() : before.str().substr(others + 1));
}

} // namespace

int main(int argc, char** argv) {
  int uploads = 1000;
  int ble_uploads = 1000;
  std::string document;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string_view option = argv[i];
    if (option == "--uploads")
      uploads = std::atoi(argv[i + 1]);
    else if (option == "--ble")
      ble_uploads = std::atoi(argv[i + 1]);
    else if (option == "--document")
      document = argv[i + 1];
  }
  Page page;
  page.add(fmt::format(R"(# How reliable uploading is

Printed by `build/release/bin/reliability --uploads {} --document docs/inside/reliability.md`, from
[Writes that fail](#writes-that-fail) on by the commands named there; do not edit. Time is virtual and every upload has
its own seed, so the numbers repeat exactly. The ball is the built-in `sphero-3.73`, which does not report its count of
packets, as neither recorded robot does. After each upload its storage is compared with the report: *ok* is a true
success, *reported* a failure whose message describes the ball truly, *wrong* everything else. Counts of 0 are left out.
The other libraries had 2000 runs each against a ball with the same faults (a duplicate there is a duplicate answer);
– was not measured.

)",
                       uploads));
  add_profiles(page, uploads, ble_uploads);
  add_ble(page, ble_uploads);
  add_doubled_requests(page, uploads);
  add_flips(page);
  add_cuts(page);
  add_full_storage(page);
  add_speed(page);
  if (!document.empty())
    write(document, page.text);
  return page.failed ? 1 : 0;
}
