#pragma once
/// What urdfdom lets pass: the XML of a URDF checked element by element, and its tree of links and joints.

#include <tinyxml.h>

#include <string>
#include <vector>

namespace gambeson {

/// Names in the file's order.
struct UrdfOrder {
  std::string root;                 ///< the link that is nobody's child
  std::vector<std::string> joints;  ///< parents before children, siblings as in the file
};

/// Parses the text; throws InputError with file and line where it is no XML, or nested deeper than 32 elements.
void parseXml(TiXmlDocument& document, const std::string& text, const std::string& file);

/// Throws InputError with file, line and element: unknown elements, attributes, geometry and joint types; missing or
/// repeated ones; anything but finite numbers; masses below 0, sizes and axes of 0, limits inverted, missing or
/// enormous; names that stand twice or do not exist; a link with two parents, a cycle, several roots; mimic joints in a
/// circle.
UrdfOrder checkUrdf(const TiXmlDocument& document, const std::string& file);

/// Line of the named link or joint, for messages.
int lineOf(const TiXmlDocument& document, const char* element, const std::string& name);

}  // namespace gambeson
