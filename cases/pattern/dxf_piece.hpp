#pragma once
/// One block of a DXF-AAMA/ASTM file as a panel.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/pattern/dxf_file.hpp"
#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

/// "PIECE NAME: front" as its two parts; nothing where a text is none of these.
std::optional<std::pair<std::string, std::string>> systemText(const DxfEntity& e);

/// What pieces have that panels have no place for, counted.
class DxfCounts {
 public:
  void add(const std::string& what) { ++count_[what]; }
  std::vector<std::string> words() const;

 private:
  std::map<std::string, int> count_;
};

/// `metres`: length of a 1; `unfolds`: halves are made whole. Throws InputError with the file, the block and the layer.
Panel panelOf(const std::filesystem::path& file, const DxfBlock& block, double metres, bool unfolds,
              std::vector<std::string>& notes, DxfCounts& dropped);

/// What stands in ENTITIES as blocks, where a file has pieces without blocks: each closed line of layer 1 that lies in
/// no other, with what lies within it. `metres`: as above. What lies in none is counted in `dropped`; texts of the
/// style are no part of a piece.
std::vector<DxfBlock> loosePieces(const std::vector<DxfEntity>& entities, double metres, DxfCounts& dropped);

}  // namespace gambeson
