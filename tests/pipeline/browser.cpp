#include "browser.h"

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace myoid::test {
namespace {

using nlohmann::json;

constexpr int kPatience_ms = 60000;

/// A driver's remark about its own speed is no complaint of the page.
bool is_about_the_driver(const std::string& text) { return text.find("GL Driver Message") != std::string::npos; }

std::string base64_decoded(const std::string& text) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned group = 0;
  unsigned bits = 0;
  for (const char c : text) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string::npos) break;
    group = (group << 6U) | static_cast<unsigned>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>((group >> bits) & 255U);
  }
  return bytes;
}

/// The browser's side: it reads commands from descriptor 3 and writes answers to descriptor 4.
[[noreturn]] void become_browser(int commands, int answers, const std::string& profile, const std::string& size) {
  const int nothing = ::open("/dev/null", O_RDWR);
  for (const int fd : {0, 1, 2}) ::dup2(nothing, fd);
  const int c = ::fcntl(commands, F_DUPFD, 100), a = ::fcntl(answers, F_DUPFD, 100);
  ::dup2(c, 3);
  ::dup2(a, 4);
  ::execlp("chromium", "chromium", "--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader",
           "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--no-first-run", "--hide-scrollbars",
           "--remote-debugging-pipe", ("--user-data-dir=" + profile).c_str(), ("--window-size=" + size).c_str(),
           "about:blank", nullptr);
  std::_Exit(127);
}

}  // namespace

bool there_is(const std::string& program) {
  return std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0;
}

Browser::Browser(int width, int height) {
  std::array<int, 2> commands{}, answers{};
  if (::pipe2(commands.data(), O_CLOEXEC) != 0 || ::pipe2(answers.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe");
  const std::string size = fmt::format("{},{}", width, height);
  const std::string profile = profile_ / "profile";
  pid_ = ::fork();
  if (pid_ == 0) become_browser(commands[0], answers[1], profile, size);
  ::close(commands[0]);
  ::close(answers[1]);
  to_browser_ = commands[1];
  from_browser_ = answers[0];
  ::signal(SIGPIPE, SIG_IGN);
  const json target = call("Target.createTarget", {{"url", "about:blank"}});
  session_ = call("Target.attachToTarget", {{"targetId", target["targetId"]}, {"flatten", true}}).at("sessionId");
  for (const char* domain : {"Page", "Runtime", "Network", "Log"}) call(std::string(domain) + ".enable");
  resize(width, height);
}

Browser::~Browser() {
  ::close(to_browser_);
  ::close(from_browser_);
  if (pid_ <= 0) return;
  ::kill(pid_, SIGTERM);
  int status = 0;
  for (int k = 0; k < 100 && ::waitpid(pid_, &status, WNOHANG) == 0; ++k) {
    if (k == 80) ::kill(pid_, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

json Browser::next_message() {
  std::size_t end = 0;
  while ((end = received_.find('\0')) == std::string::npos) {
    pollfd waiting{from_browser_, POLLIN, 0};
    if (::poll(&waiting, 1, kPatience_ms) <= 0) throw std::runtime_error("the browser is silent");
    std::array<char, 65536> buffer{};
    const ssize_t count = ::read(from_browser_, buffer.data(), buffer.size());
    if (count <= 0) throw std::runtime_error("the browser ended");
    received_.append(buffer.data(), static_cast<std::size_t>(count));
  }
  json message = json::parse(received_.substr(0, end));
  received_.erase(0, end + 1);
  return message;
}

json Browser::call(const std::string& method, const json& parameters) {
  json command{{"id", ++last_id_}, {"method", method}, {"params", parameters}};
  if (!session_.empty()) command["sessionId"] = session_;
  const std::string text = command.dump() + '\0';
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t count = ::write(to_browser_, text.data() + sent, text.size() - sent);
    if (count <= 0) throw std::runtime_error("the browser ended");
    sent += static_cast<std::size_t>(count);
  }
  while (true) {
    json message = next_message();
    if (!message.contains("id")) {
      events_.push_back(std::move(message));
    } else if (message["id"] == last_id_) {
      if (message.contains("error")) throw std::runtime_error(method + message["error"].dump());
      return message["result"];
    }
  }
}

json Browser::evaluate(const std::string& expression) {
  const json answer =
      call("Runtime.evaluate", {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
  if (answer.contains("exceptionDetails"))
    throw std::runtime_error(expression + ": " + answer["exceptionDetails"].dump());
  return answer["result"].value("value", json());
}

void Browser::wait_for(const std::string& expression) {
  std::string error;
  for (int k = 0; k < kPatience_ms / 20; ++k) {
    try {
      if (evaluate(expression) == true) return;
    } catch (const std::runtime_error& between_two_pages) {  // the next has no body yet
      error = between_two_pages.what();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  throw std::runtime_error("never true: " + expression + " " + error);
}

void Browser::open(const std::string& address) {
  call("Page.navigate", {{"url", "about:blank"}});  // an address that differs in its # alone loads too
  call("Page.navigate", {{"url", address}});
  wait_for(
      "location.href !== 'about:blank' && document.readyState === 'complete' && "
      "(!document.querySelector('script') || document.body.dataset.state === 'ready')");
}

void Browser::resize(int width, int height) {
  call("Emulation.setDeviceMetricsOverride",
       {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

void Browser::prefer(const std::string& feature, const std::string& value) {
  call("Emulation.setEmulatedMedia", {{"features", json::array({{{"name", feature}, {"value", value}}})}});
}

void Browser::show_on(const std::string& medium) { call("Emulation.setEmulatedMedia", {{"media", medium}}); }

void Browser::set_scripts(bool on) { call("Emulation.setScriptExecutionDisabled", {{"value", !on}}); }

void Browser::mouse(const std::string& type, double x, double y, int clicks, int buttons) {
  call("Input.dispatchMouseEvent", {{"type", type},
                                    {"x", x},
                                    {"y", y},
                                    {"button", clicks > 0 || buttons > 0 ? "left" : "none"},
                                    {"buttons", buttons},
                                    {"clickCount", clicks}});
}

void Browser::move(double x, double y) { mouse("mouseMoved", x, y, 0, 0); }

void Browser::click(double x, double y, int clicks) {
  move(x, y);
  for (int k = 1; k <= clicks; ++k) {
    mouse("mousePressed", x, y, k, 1);
    mouse("mouseReleased", x, y, k, 0);
  }
}

void Browser::drag(double from_x, double to_x, double y) {
  move(from_x, y);
  mouse("mousePressed", from_x, y, 1, 1);
  mouse("mouseMoved", 0.5 * (from_x + to_x), y, 0, 1);
  mouse("mouseMoved", to_x, y, 0, 1);
  mouse("mouseReleased", to_x, y, 1, 0);
}

void Browser::press(const std::string& key) {
  const json text = key.size() == 1 ? json{{"text", key}} : json::object();
  json parameters{{"type", "keyDown"}, {"key", key}};
  parameters.update(text);
  call("Input.dispatchKeyEvent", parameters);
  call("Input.dispatchKeyEvent", {{"type", "keyUp"}, {"key", key}});
}

std::string Browser::pdf() { return base64_decoded(call("Page.printToPDF", {{"preferCSSPageSize", true}}).at("data")); }

std::vector<std::string> Browser::complaints() {
  evaluate("1");  // the events before are here now
  std::vector<std::string> found;
  for (const json& event : events_) {
    const std::string method = event.value("method", "");
    if (method == "Runtime.exceptionThrown" || method == "Runtime.consoleAPICalled")
      found.push_back(event["params"].dump());
    if (method == "Log.entryAdded") found.push_back(event["params"]["entry"].value("text", ""));
    if (method == "Network.requestWillBeSent") {
      const std::string url = event["params"]["request"].value("url", "");
      const std::string type = event["params"].value("type", "");
      const bool own = (url.starts_with("file:") && (type == "Document" || type == "Media")) ||
                       url.starts_with("blob:");  // of the page's own memory
      if (!own && !url.starts_with("about:")) found.push_back("request of " + url);
    }
  }
  std::erase_if(found, is_about_the_driver);
  return found;
}

}  // namespace myoid::test
