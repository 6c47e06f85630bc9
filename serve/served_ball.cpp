#include "serve/served_ball.h"

#include "disk/disk.h"
#include "protocol/recording.h"
#include "serve/open_pty.h"
#include "serve/tcp_link.h"
#include "vm/common/bluetooth.h"
#include "vm/state.h"

#include <algorithm>
#include <array>
#include <asio/post.hpp>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <unistd.h>
#include <utility>

namespace orb::serve {
namespace {

/// Stop reading from a client while this much output waits for it.
constexpr std::size_t backlog_most = 256 * 1024;
constexpr std::size_t read_size = 64 * 1024; // bytes at once
/// Most reads from a departed client when the next one arrives.
constexpr int farewell_reads = 64;

/// Returns a separate seed for each ball, so that their events differ.
std::uint64_t seed_of(std::uint64_t seed, int index) {
  return seed + static_cast<std::uint64_t>(index);
}

double seconds(Instant since_start) {
  return std::chrono::duration<double>(since_start.time_since_epoch()).count();
}

bool only_later(ssize_t result) {
  return result < 0 && (errno == EAGAIN || errno == EINTR);
}

} // namespace

ServedBall::ServedBall(asio::io_context& io, const ServeOptions& options, int index,
                       FakeBluez* bluez)
    : io_(io), options_(options), index_(index), bluez_(bluez),
      spectator_(options.watch ? options.watch(index) : nullptr),
      witness_(options.hear ? options.hear(index) : nullptr), timer_(io) {
  if (options.fault) {
    auto plan = *options.fault;
    plan.seed = seed_of(plan.seed, index);
    pipe_.emplace(plan, spec::info(options.robot).packets);
  }
  make_ball();
}

vm::BallOptions ServedBall::ball_options() {
  auto ball = options_.ball;
  ball.seed = seed_of(ball.seed, index_);
  ball.wire = vm::Wire::Unpaced;
  if (spectator_ != nullptr)
    ball.observer = this;
  return ball;
}

/// Creates the ball, whose time begins at `born_`.
void ServedBall::make_ball() {
  const auto options = ball_options();
  device_.emplace(options);
  device_->ball().schedule(options_.stimulus);
}

// Opening.

/// Adds the ball's number to a name, if several balls are served.
std::string ServedBall::numbered(const std::string& name) const {
  return options_.count == 1 || name.empty() ? name : fmt::format("{}-{}", name, index_ + 1);
}

tl::expected<void, IoError> ServedBall::load() {
  const auto path = numbered(options_.state_file);
  if (path.empty())
    return {};
  auto lock =
      disk::Lock::take(path, Duration{}, "stop that ball, or give this one a different `--state`");
  if (!lock)
    return tl::unexpected(lock.error());
  lock_ = *std::move(lock);
  if (::access(path.c_str(), F_OK) != 0)
    return {}; // a new ball
  const auto text = disk::read(path);
  if (!text)
    return tl::unexpected(text.error());
  if (const auto loaded = vm::load_state(*text, ball()); !loaded)
    return tl::unexpected(
        IoError{fmt::format("{} cannot be used as a ball's state: {}; remove it to start with "
                            "a new ball, or give another file",
                            path, loaded.error())});
  saved_revision_ = ball().dispatcher().revision();
  return {};
}

tl::expected<void, IoError> ServedBall::open_pty() {
  auto pty = open_pty_link(io_, numbered(options_.pty_link));
  if (!pty && pty.error().has_no_pty && options_.tcp) {
    options_.warn(pty.error().error.message + "; this ball is on TCP only");
    return {};
  }
  if (!pty)
    return tl::unexpected(pty.error().error);
  links_.push_back(*std::move(pty));
  return {};
}

tl::expected<void, IoError> ServedBall::open_tcp(const ServeOptions::Tcp& place) {
  auto tcp = std::make_unique<TcpLink>(io_);
  if (auto opened = tcp->listen(place.host, place.port == 0 ? 0 : place.port + index_); !opened)
    return opened;
  if (tcp->is_exposed() && index_ == 0)
    options_.warn(
        fmt::format("anyone who can reach {} over the network can drive and change this ball; "
                    "127.0.0.1 keeps it to this machine",
                    tcp->address()));
  links_.push_back(std::move(tcp));
  return {};
}

/// Advertises the name that such a robot has: its kind, and the end of its address.
void ServedBall::open_ble(FakeBluez& bluez) {
  const auto options = ball_options();
  const auto model = options.firmware == spec::Firmware::Bb8 ? spec::BleModel::Bb8
                                                             : spec::info(options_.robot).ble;
  const auto address = vm::bluetooth_address(options.seed);
  links_.push_back(bluez.make_robot(vm::advertised_name(model, address), address, model));
}

tl::expected<void, IoError> ServedBall::open() {
  if (auto loaded = load(); !loaded)
    return loaded;
  if (!options_.log_file.empty()) {
    const auto path = numbered(options_.log_file);
    log_.open(disk::as_path(path));
    if (!log_)
      return tl::unexpected(
          IoError{fmt::format("cannot write {}: {}", path, std::strerror(errno))});
  }
  if (options_.pty)
    if (auto opened = open_pty(); !opened)
      return opened;
  if (bluez_ != nullptr)
    open_ble(*bluez_);
  return options_.tcp ? open_tcp(*options_.tcp) : tl::expected<void, IoError>{};
}

tl::expected<void, IoError> ServedBall::save() {
  if (options_.state_file.empty())
    return {};
  saved_revision_ = ball().dispatcher().revision();
  return disk::write(numbered(options_.state_file), as_bytes(vm::save_state(ball())));
}

std::string ServedBall::addresses() const {
  std::string out;
  for (const auto& link : links_)
    out += link->address() + "\n";
  return out;
}

void ServedBall::start(Clock::time_point start) {
  start_ = start;
  if (spectator_ != nullptr)
    spectator_->on_begin(born_, ball());
  for (const auto& link : links_)
    link->start(*this);
  step();
}

// Time. Based on the steady clock; the ball's own time runs faster or slower.

Instant ServedBall::real_time() const {
  return Instant{} + std::chrono::duration_cast<Duration>(Clock::now() - start_);
}

Instant ServedBall::now() const {
  const auto real = static_cast<double>(real_time().time_since_epoch().count());
  return Instant{} + Duration{static_cast<Duration::rep>(real * options_.speed)};
}

// Control lines.

std::string ServedBall::obey(const Control& control) {
  const auto time = now();
  live_until(time);
  std::string answer = "ok";
  if (const auto* happens = std::get_if<Control::Now>(&control.what))
    ball().apply(happens->stimulus);
  else if (const auto* later = std::get_if<vm::TimedStimulus>(&control.what)) {
    const auto wait = later->at - time.time_since_epoch();
    if (wait < Duration{})
      return fmt::format("error: it is {:.3f} s now; write a later time, or `at now`",
                         seconds(time));
    const vm::TimedStimulus event{wait, later->stimulus};
    ball().schedule({&event, 1});
  } else if (std::holds_alternative<Control::Reset>(control.what))
    reset();
  else
    answer = state();
  step();
  return answer;
}

/// Power-cycles the ball and returns it to its starting place. The client stays connected.
void ServedBall::reset() {
  const auto kept = vm::save_state(ball());
  born_ = now();
  make_ball();
  static_cast<void>(vm::load_state(kept, ball())); // cannot fail: save_state() wrote it
  saved_revision_ = ball().dispatcher().revision();
  if (spectator_ != nullptr)
    spectator_->on_begin(born_, ball());
  spacer_.clear();
  if (client_ == nullptr)
    return;
  device_->connect();
}

std::string ServedBall::state() const {
  const auto& body = ball().body();
  const auto pose = body.pose();
  const auto color = ball().led();
  const auto is = [](bool so) { return so ? "yes" : "no"; };
  return fmt::format("t={:.3f} x={:.2f} y={:.2f} heading={:.2f} speed={:.2f} rgb={},{},{} "
                     "client={} program={} macro={} asleep={} volts={:.2f}",
                     seconds(now()), pose.x_cm, pose.y_cm, pose.heading_deg, pose.speed_cm_s,
                     color.red, color.green, color.blue, is(ball().connected()),
                     is(ball().basic_running()), is(ball().macros().running()), is(ball().asleep()),
                     body.battery_v());
}

/// Explains why the client was disconnected.
std::string ServedBall::asleep() const {
  const auto own = seconds(now()) - seconds(born_);
  const auto name = options_.count == 1 ? "the ball" : fmt::format("ball {}", index_ + 1);
  return fmt::format("{} fell asleep at {:.0f} s of its time{}, which ends its connection; "
                     "connecting wakes it",
                     name, own,
                     options_.speed == 1 ? "" : fmt::format(" (`--speed {:g}`)", options_.speed));
}

void ServedBall::end() {
  live_until(now());
  if (spectator_ != nullptr)
    spectator_->on_end(now());
}

// Clients.

bool ServedBall::admits() {
  if (client_ == nullptr || !client_->client_left())
    return client_ == nullptr;
  // Handle the last input of the departed client before the next one may enter.
  const auto session = session_;
  for (int i = 0; i < farewell_reads && session == session_; ++i)
    on_input();
  if (session == session_)
    leave();
  return client_ == nullptr;
}

void ServedBall::enter(Link& link) {
  client_ = &link;
  ++session_;
  live_until(now());
  if (witness_ != nullptr)
    witness_->on_client(now());
  device_->connect();
  if (pipe_)
    pipe_->reconnect(now());
  await_input();
  step();
}

void ServedBall::leave() {
  if (client_ == nullptr)
    return;
  auto& link = *std::exchange(client_, nullptr);
  ++session_;
  spacer_.clear();
  backlog_.clear();
  writing_ = reading_ = false;
  live_until(now());
  if (witness_ != nullptr)
    witness_->on_parting(now());
  device_->disconnect();
  link.hang_up();
  step();
}

void ServedBall::wait_client(Link::Ready ready, void (ServedBall::*handler)()) {
  client_->wait(ready, [this, session = session_, handler] {
    if (session == session_)
      (this->*handler)();
  });
}

// Input.

void ServedBall::await_input() {
  if (reading_ || client_ == nullptr || backlog_.size() > backlog_most)
    return;
  reading_ = true;
  wait_client(Link::Ready::Read, &ServedBall::on_input);
}

void ServedBall::on_input() {
  static thread_local std::array<std::uint8_t, read_size> buffer;
  reading_ = false;
  const auto size = client_->read(buffer);
  if (only_later(size))
    return await_input();
  if (size <= 0) // end of file, or EIO when the slave of a pty was closed
    return leave();
  const auto bytes = ByteView(buffer).first(static_cast<std::size_t>(size));
  log(protocol::Direction::ToBall, bytes);
  live_until(now());
  if (pipe_)
    pipe_->push(protocol::Direction::ToBall, bytes, now());
  else
    device_->receive(bytes);
  const auto session = session_;
  step();
  if (session == session_)
    await_input();
}

// Time and output.

void ServedBall::step() {
  const auto time = now();
  live_until(time);
  if (pipe_) {
    for (auto bytes = pipe_->take(protocol::Direction::ToBall, time); !bytes.empty();
         bytes = pipe_->take(protocol::Direction::ToBall, time))
      device_->receive(bytes);
    live_until(time);
  }
  if (!options_.state_file.empty() && ball().dispatcher().revision() != saved_revision_)
    if (auto saved = save(); !saved)
      fail(saved.error()); // answers still go out: the ball itself has changed
  take_packets();
  const auto session = session_;
  if (pipe_)
    send_faulty();
  for (const auto& bytes : spacer_.take(real_time()))
    write(bytes);
  // Sleep ends the connection; a client that cannot be hung up on is just ignored.
  if (session == session_ && client_ != nullptr && client_->can_hang_up() && !ball().connected() &&
      backlog_.empty() && !spacer_.has_messages()) {
    if (ball().asleep())
      options_.note(asleep());
    leave();
  }
  arm();
  if (spectator_ != nullptr && spectator_->has_enough())
    io_.stop();
}

void ServedBall::take_packets() {
  const bool is_v2 = spec::info(options_.robot).packets == spec::Packets::V2;
  const auto session = session_;
  while (auto packet = device_->take_packet()) {
    if (client_ == nullptr || session != session_)
      continue;
    if (pipe_) {
      pipe_->push(protocol::Direction::FromBall, *packet, now());
      continue;
    }
    if (is_v2) {
      if (backlog_.size() <= backlog_most)
        write(*packet);
      continue;
    }
    if ((*packet)[1] == spec::sop2_async) {
      if (backlog_.size() <= backlog_most)
        spacer_.add_message(std::move(*packet), real_time());
      continue;
    }
    // After streaming stops, no sensor data may follow the answer that confirms it.
    if (spacer_.has_messages() && ball().streamer().next_event() == never)
      spacer_.hurry();
    spacer_.add_answer(std::move(*packet));
  }
}

/// The fault plan decides whether and when packets leave.
void ServedBall::send_faulty() {
  const auto time = now();
  const auto session = session_;
  for (auto bytes = pipe_->take(protocol::Direction::FromBall, time);
       !bytes.empty() && session == session_;
       bytes = pipe_->take(protocol::Direction::FromBall, time))
    write(bytes);
  if (pipe_->cut() && session == session_)
    leave();
}

void ServedBall::write(ByteView bytes) {
  if (client_ == nullptr)
    return;
  log(protocol::Direction::FromBall, bytes);
  if (backlog_.empty()) {
    const auto sent = client_->write(bytes);
    if (sent < 0 && !only_later(sent))
      return lose_client();
    bytes = bytes.subspan(static_cast<std::size_t>(std::max<ssize_t>(0, sent)));
  }
  if (bytes.empty())
    return;
  backlog_.insert(backlog_.end(), bytes.begin(), bytes.end());
  write_backlog();
}

/// Disconnects the client once the present write has returned.
void ServedBall::lose_client() {
  asio::post(io_, [this, session = session_] {
    if (session == session_)
      leave();
  });
}

void ServedBall::write_backlog() {
  if (!std::exchange(writing_, true))
    wait_client(Link::Ready::Write, &ServedBall::on_writable);
}

void ServedBall::on_writable() {
  writing_ = false;
  const auto sent = client_->write(backlog_);
  if (sent < 0 && !only_later(sent))
    return leave();
  backlog_.erase(backlog_.begin(), backlog_.begin() + std::max<ssize_t>(0, sent));
  if (!backlog_.empty())
    write_backlog();
  await_input();
}

/// Sets the timer to the next event.
void ServedBall::arm() {
  auto wake = Clock::time_point::max();
  const auto next = std::min(since_start(device_->next_event()), pipe_ ? pipe_->next_due() : never);
  if (next != never) {
    const auto real = static_cast<double>(next.time_since_epoch().count()) / options_.speed;
    constexpr double century = 3e18;
    if (real < century)
      wake = start_ + Duration{static_cast<Duration::rep>(real) + 1};
  }
  if (spacer_.has_messages())
    wake = std::min(wake, start_ + spacer_.next_due().time_since_epoch());
  if (wake == armed_)
    return;
  armed_ = wake;
  if (wake == Clock::time_point::max()) {
    timer_.cancel();
    return;
  }
  timer_.expires_at(wake);
  timer_.async_wait([this](asio::error_code error) {
    if (error)
      return;
    armed_ = Clock::time_point::max();
    step();
  });
}

void ServedBall::log(protocol::Direction direction, ByteView bytes) {
  if (witness_ != nullptr)
    witness_->on_bytes(now(), direction, bytes);
  if (!log_.is_open())
    return;
  const auto line =
      fmt::format("{:.3f} {}", seconds(now()), protocol::recording_line(direction, bytes));
  if (!(log_ << line << std::flush)) {
    fail({fmt::format("cannot write {}: {}", numbered(options_.log_file), std::strerror(errno))});
    log_.close();
  }
}

/// Reports the error at once, because a ball may be served for days.
void ServedBall::fail(const IoError& error) {
  if (!error_)
    options_.warn(error.message);
  error_ = error;
}

} // namespace orb::serve
