#pragma once
// Reads a text line by line, word by word, and remembers where it is.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include "core/error.h"

namespace windfall::meshfile {

/// Words are separated by blanks; lines end with LF, CR LF or CR.
class TextScanner {
  public:
    TextScanner(std::string_view text, std::string name) : m_text(text), m_name(std::move(name)) {}

    /// Goes to the next line; false when there is none.
    bool next_line() {
        if (m_next >= m_text.size()) return false;
        const std::size_t end = std::min(m_text.find_first_of("\r\n", m_next), m_text.size());
        m_line = m_text.substr(m_next, end - m_next);
        m_next = end + 1;
        if (end + 1 < m_text.size() && m_text[end] == '\r' && m_text[end + 1] == '\n') ++m_next;
        ++m_number;
        return true;
    }

    /// The next word of the line, empty at its end.
    std::string_view word() {
        const std::size_t begin = m_line.find_first_not_of(" \t");
        if (begin == std::string_view::npos) return {};
        const std::size_t end = std::min(m_line.find_first_of(" \t", begin), m_line.size());
        const std::string_view result = m_line.substr(begin, end - begin);
        m_line.remove_prefix(end);
        return result;
    }

    /// All that is left of the line, without blanks around it.
    std::string_view rest() const {
        const std::size_t begin = m_line.find_first_not_of(" \t");
        if (begin == std::string_view::npos) return {};
        return m_line.substr(begin, m_line.find_last_not_of(" \t") + 1 - begin);
    }

    template <class T>
    T number(std::string_view text) const {
        T value{};
        if (!text.empty() && text.front() == '+') text.remove_prefix(1);
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (problem != std::errc{} || end != text.data() + text.size())
            fail(fmt::format("\"{}\" is not a number", text));
        return value;
    }

    /// Throws InputError: file, line, `what`.
    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(fmt::format("{}:{}: {}; export the mesh again", m_name, m_number, what));
    }

    std::size_t line_number() const { return m_number; }
    /// Where the text goes on behind this line.
    std::size_t offset() const { return std::min(m_next, m_text.size()); }

  private:
    std::string_view m_text, m_line;
    std::string m_name;
    std::size_t m_next = 0, m_number = 0;
};

}  // namespace windfall::meshfile
