#include "app/views/chartCaption.h"

#include <QCoreApplication>
#include <QStringList>

namespace faintline {

namespace {

    constexpr int longest = 900; ///< letters

    QString tr(const char *text)
    {
        return QCoreApplication::translate("chartCaption", text);
    }

    QString wordOf(const Json &value)
    {
        return value.is_string() ? QString::fromStdString(value.get<std::string>())
                                 : QString::fromStdString(value.dump());
    }

    bool isPlain(const Json &list)
    {
        return std::none_of(list.begin(), list.end(), [](const Json &value) { return value.is_structured(); });
    }

    void addTo(QStringList &parts, const QString &name, const Json &json)
    {
        const QString prefix = name.isEmpty() ? QString() : name + QLatin1Char('.');
        if (json.is_object()) {
            for (const auto &[key, value] : json.items())
                addTo(parts, prefix + QString::fromStdString(key), value);
        } else if (json.is_array() && !isPlain(json)) {
            for (std::size_t i = 0; i < json.size(); ++i)
                addTo(parts, prefix + QString::number(i + 1), json[i]);
        } else if (json.is_array()) {
            QStringList words;
            for (const Json &value : json)
                words << wordOf(value);
            parts << QStringLiteral("%1 = %2").arg(name, words.join(QStringLiteral(", ")));
        } else {
            parts << QStringLiteral("%1 = %2").arg(name, wordOf(json));
        }
    }

    QString joined(QStringList parts)
    {
        const QString program = QStringLiteral("Faintline " FAINTLINE_VERSION);
        QString text = parts.join(QStringLiteral("; "));
        if (text.size() > longest)
            text = text.left(longest) + QStringLiteral(" …");
        return text.isEmpty() ? program : QStringLiteral("%1. %2").arg(text, program);
    }

    QStringList partsOf(const Json &json)
    {
        QStringList parts;
        addTo(parts, {}, json);
        return parts;
    }

} // namespace

QString captionOf(const Json &json)
{
    return joined(partsOf(json));
}

QString captionOf(const Document &document)
{
    if (document.isEmpty())
        return joined({});
    return joined(QStringList{document.sourceName()} + partsOf(Json::parse(settingsToJson(document.settings()))));
}

QString captionOf(const Experiments::Entry &entry)
{
    QStringList parts{entry.name};
    if (entry.campaign)
        parts << tr("%1 runs").arg(entry.runsDone()) << partsOf(toJson(entry.campaign->experiment));
    return joined(parts);
}

} // namespace faintline
