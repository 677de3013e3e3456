#include "haptic_server/imaging/nrrd_header.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <vector>

#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {

/// No sane header is longer; what is, is some other file.
constexpr int most_header_lines = 4096;

std::string without_blanks_around(std::string text) {
    const auto is_space = [](unsigned char c) { return std::isspace(c) != 0; };
    text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), is_space));
    text.erase(std::find_if_not(text.rbegin(), text.rend(), is_space).base(), text.end());
    return text;
}

/// The numbers of "(a,b,c) (d,e,f)" or "a b c", one list per word; a word that is no number gives NaN.
std::vector<std::vector<double>> numbers_of_words(std::string text) {
    // Blanks within parentheses belong to the word.
    bool inside = false;
    std::erase_if(text, [&](char c) {
        if (c == '(') inside = true;
        if (c == ')') inside = false;
        return inside && c == ' ';
    });
    std::vector<std::vector<double>> words;
    std::istringstream line(text);
    for (std::string word; line >> word;) {
        std::replace_if(
            word.begin(), word.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
        std::istringstream parts(word);
        std::vector<double> numbers;
        for (std::string part; parts >> part;) {
            char* end = nullptr;
            const double value = std::strtod(part.c_str(), &end);
            numbers.push_back(*end == '\0' ? value : std::nan(""));
        }
        words.push_back(numbers);
    }
    return words;
}

}  // namespace

std::map<std::string, std::string> read_nrrd_header(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw ImagingError(path, "cannot be opened");
    std::string line;
    if (!std::getline(file, line) || line.rfind("NRRD", 0) != 0)
        throw ImagingError(path, "is not a NRRD file (its first line must begin with NRRD)");
    std::map<std::string, std::string> header;
    for (int i = 0; i < most_header_lines && std::getline(file, line); ++i) {
        line = without_blanks_around(line);
        if (line.empty()) break;
        const std::size_t colon = line.find(':');
        if (line[0] == '#' || colon == std::string::npos) continue;
        if (colon + 1 < line.size() && line[colon + 1] == '=') continue;
        std::string name = line.substr(0, colon);
        std::transform(name.begin(), name.end(), name.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        header[name] = without_blanks_around(line.substr(colon + 1));
    }
    return header;
}

void require_spacing(const std::filesystem::path& path, const std::map<std::string, std::string>& header) {
    for (const char* field : {"spacings", "space directions"}) {
        const auto found = header.find(field);
        if (found == header.end()) continue;
        for (const std::vector<double>& word : numbers_of_words(found->second)) {
            double squared = 0.0;
            for (const double number : word) squared += number * number;
            if (!(squared > 0.0) || !std::isfinite(squared))
                throw ImagingError(path, std::string(field) + " '" + found->second +
                                             "': every axis needs a spacing in mm that is a number above 0");
        }
    }
}

}  // namespace osteomill
