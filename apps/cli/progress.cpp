#include "progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace windfall::cli {
namespace {

double fraction_of(const Progress& progress) {
    const double fraction = progress.total > 0 ? progress.done / progress.total : 0;
    return std::clamp(std::isfinite(fraction) ? fraction : 0, 0.0, 1.0);
}

/// Texts on stderr and, at the end, where things are on stdout.
class TextPrinter : public ProgressPrinter {
  public:
    void warning(const std::string& text) override { fmt::print(stderr, "windfall: warning: {}\n", text); }
    void frame(const take::Frame&) override {}
    void done(const std::filesystem::path& take,
              const std::vector<std::filesystem::path>& pictures) override {
        fmt::print("take: {}\n", take.string());
        for (const auto& picture : pictures) fmt::print("picture: {}\n", picture.string());
        std::fflush(stdout);
    }
    void written(const std::vector<std::filesystem::path>& files) override {
        for (const auto& file : files) fmt::print("file: {}\n", file.string());
        std::fflush(stdout);
    }
    void error(const std::string&, int) override {}
};

class PlainPrinter final : public TextPrinter {
  public:
    void progress(const Progress& progress) override {
        const int tenth = static_cast<int>(fraction_of(progress) * 10 + 1e-9);
        if (progress.stage == m_stage && tenth <= m_tenth) return;
        m_stage = progress.stage;
        m_tenth = tenth;
        std::string line = fmt::format("{}: {} %", progress.stage, tenth * 10);
        if (!progress.detail.empty()) line += ", " + progress.detail;
        if (const std::string left = time_left_text(progress.seconds_left); !left.empty())
            line += ", " + left;
        fmt::print(stderr, "{}\n", line);
    }

  private:
    std::string m_stage;
    int m_tenth = -1;
};

class BarPrinter final : public TextPrinter {
  public:
    BarPrinter() = default;
    ~BarPrinter() override { clear(); }
    BarPrinter(const BarPrinter&) = delete;
    BarPrinter& operator=(const BarPrinter&) = delete;
    void warning(const std::string& text) override {
        clear();
        TextPrinter::warning(text);
    }
    void progress(const Progress& progress) override {
        const auto now = std::chrono::steady_clock::now();
        if (m_shown && progress.stage == m_stage && progress.done < progress.total &&
            now - m_last < kInterval)
            return;
        m_stage = progress.stage;
        m_last = now;
        const double fraction = fraction_of(progress);
        const auto filled = static_cast<std::size_t>(fraction * kBarWidth);
        std::string line = fmt::format("{} [{}{}] {:3.0f} %", progress.stage, std::string(filled, '#'),
                                       std::string(kBarWidth - filled, '.'), std::floor(100 * fraction));
        if (const std::string left = time_left_text(progress.seconds_left); !left.empty())
            line += "  " + left;
        if (!progress.detail.empty()) line += "  " + progress.detail;
        // A line that wraps could not be written over.
        line.resize(std::min(line.size(), terminal_width() - 1));
        fmt::print(stderr, "\r{}\x1b[K", line);
        std::fflush(stderr);
        m_shown = true;
    }
    void done(const std::filesystem::path& take,
              const std::vector<std::filesystem::path>& pictures) override {
        clear();
        TextPrinter::done(take, pictures);
    }
    void written(const std::vector<std::filesystem::path>& files) override {
        clear();
        TextPrinter::written(files);
    }
    void error(const std::string&, int) override { clear(); }

  private:
    static constexpr std::chrono::milliseconds kInterval{100};
    static constexpr std::size_t kBarWidth = 30;

    static std::size_t terminal_width() {
        winsize size{};
        const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
        return known ? size.ws_col : 80;
    }
    void clear() {
        if (m_shown) fmt::print(stderr, "\r\x1b[K");
        m_shown = false;
    }

    std::string m_stage;
    std::chrono::steady_clock::time_point m_last;
    bool m_shown = false;
};

class JsonPrinter final : public ProgressPrinter {
  public:
    void warning(const std::string& text) override { print({{"event", "warning"}, {"message", text}}); }
    void progress(const Progress& p) override {
        const bool known = std::isfinite(p.seconds_left) && p.seconds_left >= 0;
        print({{"event", "progress"},
               {"stage", p.stage},
               {"done", p.done},
               {"total", p.total},
               {"seconds_left", known ? nlohmann::json(p.seconds_left) : nlohmann::json(nullptr)},
               {"detail", p.detail}});
    }
    void frame(const take::Frame& frame) override {
        print({{"event", "frame"}, {"index", frame.index}, {"time", frame.time}, {"scalars", frame.scalars}});
    }
    void done(const std::filesystem::path& take,
              const std::vector<std::filesystem::path>& pictures) override {
        print({{"event", "done"}, {"take", take.string()}, {"pictures", texts(pictures)}});
    }
    void written(const std::vector<std::filesystem::path>& files) override {
        print({{"event", "done"}, {"files", texts(files)}});
    }
    void error(const std::string& text, int exit_code) override {
        print({{"event", "error"}, {"message", text}, {"exit_code", exit_code}});
    }

  private:
    static nlohmann::json texts(const std::vector<std::filesystem::path>& paths) {
        nlohmann::json result = nlohmann::json::array();
        for (const auto& path : paths) result.push_back(path.string());
        return result;
    }
    static void print(const nlohmann::json& event) {
        // Paths and messages may hold bytes that are not UTF-8; a reader of lines must get JSON all the same.
        fmt::print("{}\n", event.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
        std::fflush(stdout);
    }
};

}  // namespace

const std::vector<std::string>& progress_kinds() {
    static const std::vector<std::string> kKinds = {"plain", "bar", "json"};
    return kKinds;
}

std::unique_ptr<ProgressPrinter> make_progress_printer(const std::string& kind) {
    if (kind == "json") return std::make_unique<JsonPrinter>();
    const bool bar = kind.empty() ? isatty(STDERR_FILENO) == 1 : kind == "bar";
    if (bar) return std::make_unique<BarPrinter>();
    return std::make_unique<PlainPrinter>();
}

std::string time_left_text(double seconds) {
    if (!std::isfinite(seconds) || seconds < 0) return "";
    const auto whole = static_cast<long long>(std::ceil(seconds));
    if (whole >= 3600) return fmt::format("{}:{:02}:{:02} left", whole / 3600, whole / 60 % 60, whole % 60);
    return fmt::format("{}:{:02} left", whole / 60, whole % 60);
}

}  // namespace windfall::cli
