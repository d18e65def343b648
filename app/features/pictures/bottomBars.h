#pragma once

namespace faintline {

class Document;
class OverviewStrip;
class ReadOut;
class Workbench;

/// Shows the document in the bars below the pictures of lines.
void connectOverview(OverviewStrip &strip, Document &document);
void connectReadOut(ReadOut &readOut, Document &document, Workbench &bench);

} // namespace faintline
