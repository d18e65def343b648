// The parsers of the window. A new one is one line in the table.

#include "fuzz/fuzz.h"

#include "app/base/filePath.h"
#include "app/document/Provenance.h"
#include "app/document/ViewState.h"
#include "app/document/scanScenario.h"
#include "app/headless/readPicture.h"
#include "app/headless/replayPicture.h"
#include "app/lessons/Lesson.h"
#include "base/oneLine.h"
#include "exchange/Session.h"
#include "widgets/base/labelText.h"

#include <QFileInfo>
#include <QImage>
#include <QUrl>

#include <cstdlib>

using namespace faintline;
using faintline::fuzz::Input;
using faintline::fuzz::Parser;

namespace {

/// What the window adds to a session.
void readView(const Input &input)
{
    toJson(viewFromJson(readSession(input.path).view, input.path));
}

/// What stands in a picture, without the picture's own bytes, whose checksums hide it.
void readOrigins(const Input &input)
{
    QImage picture(4, 3, QImage::Format_RGB32);
    picture.setText(pictureProvenanceKey(), QString::fromStdString(oneLine(input.text)));
    scaleOf(picture);
    originOf(picture, {input.path, {}}, QFileInfo(pathText(input.path)).path());
}

void showTexts(const Input &input)
{
    if (pathBytes(pathText(input.text)) != input.text)
        std::abort();
    const QString label = labelText(input.text);
    if (label.size() > mostLabelLetters || !label.isValidUtf16()
        || oneLine(label.toStdString()) != label.trimmed().toStdString())
        std::abort();
    const QString message = messageText(input.text);
    if (!message.isValidUtf16() || oneLine(message.toStdString()) != message.trimmed().toStdString())
        std::abort();
    paragraphs(input.text);
    if (!nameBeside(pathText(input.text), QStringLiteral(".html")).isValidUtf16())
        std::abort();
    pathOf(QUrl(QString::fromStdString(input.text)));
}

} // namespace

const std::vector<Parser> &faintline::fuzz::parsers()
{
    static const std::vector<Parser> all{
        {"view", ".faintline", readView},
        {"lesson", ".json", [](const Input &input) { lessonFromJson(input.text, QStringLiteral("lesson.json")); }},
        {"scans", ".json", [](const Input &input) { readScanTest(pathText(input.path)); }},
        {"picture", ".png", [](const Input &input) { scaleOf(readPicture(pathText(input.path))); }},
        {"pictureOrigin", ".txt", readOrigins},
        {"labels", ".txt", showTexts},
    };
    return all;
}
