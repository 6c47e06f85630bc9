#pragma once

// Private to vm/ball*.cpp: answers the requests of programs, macros and clients.

#include "vm/api/api_host.h"
#include "vm/ball.h"
#include "vm/machine/host.h"
#include "vm/macros/macro_host.h"

namespace orb::vm {

struct Ball::Asks {
  explicit Asks(Ball& ball) : of_program(ball), of_macro(ball), of_client(ball) {}

  class OfProgram final : public Host {
  public:
    explicit OfProgram(Ball& ball) : ball_(ball) {}
    std::int32_t read(spec::Variable variable, Instant now) override;
    std::optional<spec::BasicError> write(spec::Variable variable, std::int32_t value,
                                          Instant now) override;
    std::optional<spec::BasicError> perform(spec::Statement statement,
                                            std::span<const std::int32_t> arguments,
                                            Instant now) override;
    std::optional<Instant> print(std::string_view text, Instant now) override;
    void line_ended(int line, Instant now) override;

  private:
    Ball& ball_;
  };

  class OfMacro final : public MacroHost {
  public:
    explicit OfMacro(Ball& ball) : ball_(ball) {}
    void drive(const Motion& motion) override { ball_.drive(Actor::Macro, motion); }
    void set_led(Color color) override { ball_.set_led(Actor::Macro, color); }
    void set_back_led(int level) override { ball_.set_back_led(level); }
    void configure_collisions(const CollisionSettings& settings) override {
      ball_.settings_.collisions = settings;
    }
    void emit_marker(int marker, int macro, int command) override;
    void trace_command(int macro, int command) override {
      ball_.trace(event::Macro{macro, command});
    }
    void sleep_ms(int time_ms) override;
    bool may_begin() override { return ball_.gate_ == nullptr || ball_.gate_->command(); }
    bool stopped() const override { return ball_.body_.stopped(); }
    bool connected() const override { return ball_.connected(); }

  private:
    Ball& ball_;
  };

  class OfClient final : public ApiHost {
  public:
    explicit OfClient(Ball& ball) : ball_(ball) {}
    Instant now() const override { return ball_.now_; }
    Link& link() override { return ball_.link_; }
    Body& body() override { return ball_.body_; }
    Streamer& streamer() override { return ball_.streamer_; }
    MacroExecutive& macros() override { return ball_.macros_; }
    Programs& programs() override { return ball_.programs_; }
    const Power& power() const override { return ball_.power_; }
    const Settings& settings() const override { return ball_.settings_; }
    void change(const Settings& settings) override { ball_.change(settings); }
    void drive(const Motion& motion) override { ball_.drive(motion); }
    void set_led(Color color) override { ball_.set_led(color); }
    void set_back_led(int level) override { ball_.set_back_led(level); }
    void stay_awake() override { ball_.stay_awake(); }
    void sleep(const Sleep& sleep) override { ball_.power_.ask_to_sleep(sleep); }
    void shut_down() override { ball_.shut_down(); }
    void command_done() override { ball_.settle(); }

  private:
    Ball& ball_;
  };

  OfProgram of_program;
  OfMacro of_macro;
  OfClient of_client;
};

} // namespace orb::vm
