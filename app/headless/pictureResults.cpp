#include "app/headless/pictureResults.h"

#include "base/Error.h"
#include "base/files/AtomicFile.h"
#include "base/files/fileName.h"
#include "base/json.h"
#include "base/oneLine.h"

#include <QXmlStreamWriter>

#include <algorithm>
#include <cstdio>

namespace faintline {

namespace {

    const char *stateName(CheckedPicture::State state)
    {
        switch (state) {
        case CheckedPicture::State::Different:
            return "different";
        case CheckedPicture::State::Missing:
            return "missing";
        case CheckedPicture::State::New:
            return "new";
        case CheckedPicture::State::Same:
            break;
        }
        return "same";
    }

    /// XML has no control characters, and text has no halves of a pair.
    std::string plainName(const CheckedPicture &one)
    {
        return oneLine(one.name.toStdString());
    }

    Json sizeJson(QSize size)
    {
        return size.isValid() ? Json{{"width", size.width()}, {"height", size.height()}} : Json(nullptr);
    }

    Json pictureJson(const CheckedPicture &one)
    {
        Json places = Json::array();
        for (const QRect &place : one.difference.places)
            places.push_back(
                {{"x", place.x()}, {"y", place.y()}, {"width", place.width()}, {"height", place.height()}});
        return {{"name", plainName(one)},
                {"state", stateName(one.state)},
                {"expected", sizeJson(one.expectedSize)},
                {"actual", sizeJson(one.actualSize)},
                {"changedPixels", one.difference.changedPixels},
                {"toleratedPixels", one.difference.toleratedPixels},
                {"places", places}};
    }

} // namespace

std::string junitText(const std::vector<CheckedPicture> &pictures)
{
    const QString suite = QStringLiteral("check-pictures");
    QByteArray text;
    QXmlStreamWriter xml(&text);
    xml.setAutoFormatting(true);
    xml.setAutoFormattingIndent(2);
    xml.writeStartDocument();
    xml.writeStartElement(QStringLiteral("testsuite"));
    xml.writeAttribute(QStringLiteral("name"), suite);
    xml.writeAttribute(QStringLiteral("tests"), QString::number(pictures.size()));
    xml.writeAttribute(QStringLiteral("failures"),
                       QString::number(std::ranges::count_if(pictures, &CheckedPicture::differs)));
    xml.writeAttribute(QStringLiteral("errors"), QStringLiteral("0"));
    for (const CheckedPicture &one : pictures) {
        xml.writeStartElement(QStringLiteral("testcase"));
        xml.writeAttribute(QStringLiteral("classname"), suite);
        xml.writeAttribute(QStringLiteral("name"), QString::fromStdString(plainName(one)));
        if (one.differs()) {
            xml.writeStartElement(QStringLiteral("failure"));
            xml.writeAttribute(QStringLiteral("type"), QLatin1String(stateName(one.state)));
            xml.writeAttribute(QStringLiteral("message"), verdictOf(one));
            xml.writeEndElement();
        }
        xml.writeEndElement();
    }
    xml.writeEndDocument();
    return text.toStdString();
}

std::string resultsJson(const std::vector<CheckedPicture> &pictures)
{
    Json json{{"pictures", Json::array()},
              {"compared", pictures.size()},
              {"differing", std::ranges::count_if(pictures, &CheckedPicture::differs)}};
    for (const CheckedPicture &one : pictures)
        json["pictures"].push_back(pictureJson(one));
    return json.dump(2, ' ', true) + "\n";
}

void runCheckPictures(const CheckOptions &options)
{
    if (!options.junit.empty())
        checkEnding(options.junit, {".xml"});
    const std::vector<CheckedPicture> pictures = checkPictures(options);
    const auto differing = std::ranges::count_if(pictures, &CheckedPicture::differs);
    if (!options.junit.empty())
        writeTextFile(options.junit, junitText(pictures));
    if (options.isJson)
        std::fputs(resultsJson(pictures).c_str(), stdout);
    else
        for (const CheckedPicture &one : pictures)
            if (one.differs() || one.difference.toleratedPixels > 0)
                std::printf("%s: %s\n", qPrintable(one.name), verdictOf(one).toUtf8().constData());
    if (differing == 0)
        return;
    throw Error("check-pictures",
                std::to_string(differing) + " of " + std::to_string(pictures.size()) + " picture(s) differ"
                    + (options.out.empty() ? "; --out DIR writes a report" : "; see " + options.out + "/index.html"),
                Error::Kind::Failure);
}

} // namespace faintline
