#include "widgets/events/EventFilter.h"

#include <QHash>
#include <QRegularExpression>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    using Quantity = std::function<double(const Event &)>;
    using Condition = std::function<bool(const Event &, const EventReview &)>;

    const QHash<QString, Quantity> &quantities()
    {
        static const QHash<QString, Quantity> table{
            {"id", [](const Event &e) { return double(e.id); }},
            {"call", [](const Event &e) { return double(e.call); }},
            {"t", [](const Event &e) { return e.onsetSeconds; }},
            {"onset", [](const Event &e) { return e.onsetSeconds; }},
            {"detect", [](const Event &e) { return e.detectSeconds; }},
            {"confirm", [](const Event &e) { return e.confirmSeconds; }},
            {"end", [](const Event &e) { return e.endSeconds; }},
            {"dur", [](const Event &e) { return e.endSeconds - e.onsetSeconds; }},
            {"f", [](const Event &e) { return e.position.empty() ? 0.0 : e.position.back(); }},
            {"range", [](const Event &e) { return e.position.empty() ? 0.0 : e.position.front(); }},
            {"bearing", [](const Event &e) { return e.position.size() < 2 ? 0.0 : e.position[1]; }},
            {"drift", [](const Event &e) { return e.driftPerSecond; }},
            {"stat", [](const Event &e) { return e.statistic; }},
            {"d", [](const Event &e) { return e.statistic; }},
            {"snr", [](const Event &e) { return e.snrDb; }},
            {"window", [](const Event &e) { return e.windowSeconds; }},
        };
        return table;
    }

    Condition comparison(const QString &term)
    {
        static const QRegularExpression pattern(QStringLiteral("^([a-z]+)(<=|>=|<|>|=|≤|≥)([-+.0-9e]+)$"));
        const auto match = pattern.match(term);
        bool isNumber = false;
        const double limit = match.captured(3).toDouble(&isNumber);
        const Quantity of = quantities().value(match.captured(1));
        if (!match.hasMatch() || !isNumber || !of)
            return {};
        const QString sign = match.captured(2);
        if (sign == QLatin1String("<"))
            return [=](const Event &e, const EventReview &) { return of(e) < limit; };
        if (sign == QLatin1String(">"))
            return [=](const Event &e, const EventReview &) { return of(e) > limit; };
        if (sign == QLatin1String("="))
            return [=](const Event &e, const EventReview &) { return std::abs(of(e) - limit) < 1e-9; };
        if (sign == QLatin1String("<=") || sign == QStringLiteral("≤"))
            return [=](const Event &e, const EventReview &) { return of(e) <= limit; };
        return [=](const Event &e, const EventReview &) { return of(e) >= limit; };
    }

    /// "class=finwhale": the class begins with it, ignoring spaces; "class=": no class.
    Condition classOf(const QString &term)
    {
        const QString key = QStringLiteral("class=");
        if (!term.startsWith(key))
            return {};
        return [name = term.mid(key.size())](const Event &, const EventReview &r) {
            const QString label = QString::fromStdString(r.label).toLower().remove(QLatin1Char(' '));
            return name.isEmpty() ? label.isEmpty() : label.startsWith(name);
        };
    }

    Condition state(const QString &term)
    {
        if (term.isEmpty())
            return {};
        if (const Condition condition = classOf(term))
            return condition;
        if (term.startsWith(QLatin1Char('!'))) {
            const Condition opposite = state(term.mid(1));
            if (!opposite)
                return {};
            return [opposite](const Event &e, const EventReview &review) { return !opposite(e, review); };
        }
        // The first word that begins with the term.
        static const std::pair<QString, Condition> words[] = {
            {QStringLiteral("open"), [](const Event &e, const EventReview &) { return e.isOpen; }},
            {QStringLiteral("confirmed"), [](const Event &e, const EventReview &) { return e.isConfirmed; }},
            {QStringLiteral("tentative"), [](const Event &e, const EventReview &) { return !e.isConfirmed; }},
            {QStringLiteral("accepted"),
             [](const Event &, const EventReview &r) { return r.verdict == Verdict::Accepted; }},
            {QStringLiteral("rejected"),
             [](const Event &, const EventReview &r) { return r.verdict == Verdict::Rejected; }},
            {QStringLiteral("unreviewed"),
             [](const Event &, const EventReview &r) { return r.verdict == Verdict::None; }},
            {QStringLiteral("merged"), [](const Event &, const EventReview &r) { return r.signal != r.event; }},
            {QStringLiteral("noted"), [](const Event &, const EventReview &r) { return !r.note.empty(); }},
            {QStringLiteral("line"), [](const Event &e, const EventReview &) { return e.kind == SignalKind::Line; }},
            {QStringLiteral("keyed"), [](const Event &e, const EventReview &) { return e.kind == SignalKind::Keyed; }},
            {QStringLiteral("spread"),
             [](const Event &e, const EventReview &) { return e.kind == SignalKind::Spread; }},
        };
        for (const auto &[word, condition] : words)
            if (word.startsWith(term))
                return condition;
        return {};
    }

} // namespace

EventFilter::EventFilter(const QString &text)
{
    const QStringList terms =
        text.toLower().replace(QChar(0x2212), QLatin1Char('-')).split(QLatin1Char(' '), Qt::SkipEmptyParts);
    for (const QString &term : terms) {
        Condition condition = comparison(term);
        if (!condition)
            condition = state(term);
        if (condition)
            m_terms.push_back(std::move(condition));
        else if (m_misunderstood.isEmpty())
            m_misunderstood = term;
    }
}

bool EventFilter::accepts(const Event &event, const EventReview &review) const
{
    return std::all_of(m_terms.begin(), m_terms.end(),
                       [&](const Condition &condition) { return condition(event, review); });
}

} // namespace faintline
