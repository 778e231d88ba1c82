#include "cases/wear/case/human.hpp"

#include "human/body/body_file.hpp"
#include "human/body/skin.hpp"
#include "human/body/urdf.hpp"
#include "human/manikin/manikin.hpp"
#include "human/skin/make_skin.hpp"

namespace gambeson {

Human skeletonOf(const HumanCase& h, CharacterReport* character) {
  if (!h.manikin.empty()) return makeManikin(h.manikin);
  if (h.character) return loadCharacter(*h.character, character);
  if (!h.segments.empty()) return markedHuman(h.segments);
  return h.body.empty() ? loadUrdf(h.urdf) : loadHuman(h.urdf, h.body);
}

Human humanOf(const HumanCase& h, CharacterReport* character) {
  Human human = skeletonOf(h, character);
  if (h.skin) human.skin = std::make_shared<const Skin>(makeSkin(human, *h.skin));
  return human;
}

}  // namespace gambeson
