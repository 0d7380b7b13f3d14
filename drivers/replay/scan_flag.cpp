#include "drivers/replay/scan_flag.h"

namespace tubesight::drivers {
namespace {

using core::Scan;

constexpr const char* header_words(Y4mInterlacing interlacing) {
  switch (interlacing) {
    case Y4mInterlacing::kUnstated: return "no I";
    case Y4mInterlacing::kProgressive: return "Ip (progressive)";
    case Y4mInterlacing::kEvenFirst: return "It (even lines first)";
    case Y4mInterlacing::kOddFirst: return "Ib (odd lines first)";
  }
  return "";
}

constexpr const char* scan_word(Scan scan) {
  switch (scan) {
    case Scan::kEvenFirst: return "even-first";
    case Scan::kOddFirst: return "odd-first";
    case Scan::kProgressive: return "progressive";
  }
  return "";
}

constexpr bool agree(Y4mInterlacing interlacing, Scan scan) {
  switch (interlacing) {
    case Y4mInterlacing::kUnstated: return true;
    case Y4mInterlacing::kProgressive: return scan == Scan::kProgressive;
    case Y4mInterlacing::kEvenFirst: return scan == Scan::kEvenFirst;
    case Y4mInterlacing::kOddFirst: return scan == Scan::kOddFirst;
  }
  return false;
}

}  // namespace

std::string why_other_scan(Y4mInterlacing interlacing, Scan scan) {
  return agree(interlacing, scan)
             ? ""
             : std::string("header says ") + header_words(interlacing) + ", expected scan = \"" +
                   scan_word(scan) + "\" as [camera] of the settings says";
}

}  // namespace tubesight::drivers
