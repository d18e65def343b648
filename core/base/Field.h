#pragma once

#include "base/Error.h"
#include "base/numberText.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace faintline {

/// Value of a setting. Enumerations are given by name.
using FieldValue = std::variant<bool, int, double, std::string, std::vector<double>>;

enum class FieldKind { Flag, Integer, Number, Choice, Numbers };

/// A value that is read and shown by a word: 0 as "automatic".
struct ValueWord {
    double value = 0.0;
    std::string word;
};

/// Describes one setting independently of the object that holds it; used by forms, documentation, checks and JSON.
struct FieldInfo {
    std::string name; ///< "spectrogram.windowSeconds"
    std::string unit; ///< "s"; "" without a unit
    double minimum = 0.0;
    double maximum = 0.0;
    std::string sentence;
    std::string label;                ///< of a form's row; "": the spelled-out name, as `labelOf` gives it
    bool isAdvanced = false;          ///< seldom changed; forms fold it away
    std::string advice;               ///< when to change it, what that costs, and its source
    std::string example;              ///< of what to type into an empty field
    std::vector<std::string> choices; ///< names of an enumeration's values
    std::vector<ValueWord> words; ///< for numbers that are no sizes, in or out of range; of Numbers, for a list of one
    FieldKind kind = FieldKind::Number;
};

/// One setting of the struct S. `get` returns nothing if S does not currently hold it (another detector is chosen).
template <class S>
struct Field : FieldInfo {
    std::function<std::optional<FieldValue>(const S &)> get;
    std::function<void(S &, const FieldValue &)> set;

    // The same field with more words: field(…).labelled("Window length").advised("Lengthen it …").
    Field labelled(std::string text) const { return with(&FieldInfo::label, std::move(text)); }
    Field advanced() const { return with(&FieldInfo::isAdvanced, true); }
    Field advised(std::string text) const { return with(&FieldInfo::advice, std::move(text)); }
    Field withExample(std::string text) const { return with(&FieldInfo::example, std::move(text)); }
    Field withWord(double value, std::string word) const
    {
        Field result = *this;
        result.words.push_back({value, std::move(word)});
        return result;
    }

private:
    template <class T>
    Field with(T FieldInfo::*member, T value) const
    {
        Field result = *this;
        result.*member = std::move(value);
        return result;
    }
};

/// The label of a field, "Window length"; without one, its name in words: "decide.falseAlarmsPerHour" → "False alarms
/// per hour".
std::string labelOf(const FieldInfo &info);

/// "halfDown" → "half down".
std::string spelledOut(std::string_view camelCase);

/// The field's word for a value; "" if it has none.
std::string wordOf(const FieldInfo &info, const FieldValue &value);

/// Converts text, which may be one of the field's words in any case, to a value of its kind and checks the range.
/// Throws Error naming the field, the text, and what would be accepted.
FieldValue parseFieldValue(const FieldInfo &info, std::string_view text);

/// Checks a value against the field's range or choices; throws Error.
void checkFieldValue(const FieldInfo &info, const FieldValue &value);

/// Error for an invalid value: "NAME = VALUE: WHY". It also carries the field name, which forms mark.
Error fieldError(const std::string &name, const std::string &value, std::string why);

/// Shortest text that reads back as the same value, in the C locale.
std::string formatFieldValue(const FieldValue &value);

/// The same, but uses the field's own word if it has one for this value.
std::string formatFieldValue(const FieldInfo &info, const FieldValue &value);

// ---- making tables -------------------------------------------------------------------------------------------------

template <class S, class T>
Field<S> field(T S::*member, std::string name, std::string unit, double minimum, double maximum, std::string sentence)
{
    FieldInfo info;
    info.name = std::move(name);
    info.unit = std::move(unit);
    info.minimum = minimum;
    info.maximum = maximum;
    info.sentence = std::move(sentence);
    if constexpr (std::is_same_v<T, int>)
        info.kind = FieldKind::Integer;
    else if constexpr (std::is_same_v<T, double>)
        info.kind = FieldKind::Number;
    else if constexpr (std::is_same_v<T, std::vector<double>>)
        info.kind = FieldKind::Numbers;
    else
        static_assert(!sizeof(T), "no field() overload for members of this type");
    return {std::move(info), [member](const S &s) -> std::optional<FieldValue> { return s.*member; },
            [member](S &s, const FieldValue &value) { s.*member = std::get<T>(value); }};
}

template <class S>
Field<S> field(bool S::*member, std::string name, std::string sentence)
{
    FieldInfo info;
    info.name = std::move(name);
    info.sentence = std::move(sentence);
    info.kind = FieldKind::Flag;
    return {std::move(info), [member](const S &s) -> std::optional<FieldValue> { return s.*member; },
            [member](S &s, const FieldValue &value) { s.*member = std::get<bool>(value); }};
}

/// An enumeration whose values 0, 1, … have the given names.
template <class S, class E>
requires std::is_enum_v<E> Field<S> field(E S::*member, std::string name, std::span<const std::string_view> names,
                                          std::string sentence)
{
    FieldInfo info;
    info.name = std::move(name);
    info.sentence = std::move(sentence);
    info.kind = FieldKind::Choice;
    info.choices.assign(names.begin(), names.end());
    return {
        std::move(info),
        [member, names](const S &s) -> std::optional<FieldValue> { return std::string(names[std::size_t(s.*member)]); },
        [member, names](S &s, const FieldValue &value) {
            for (std::size_t i = 0; i < names.size(); ++i)
                if (names[i] == std::get<std::string>(value))
                    s.*member = static_cast<E>(i);
        }};
}

/// Table of an inner struct, seen from the struct that contains it. Names get a prefix. `reach` maps Outer (const or
/// not) to a pointer to Inner, null if Outer does not hold one.
template <class Outer, class Inner, class Reach>
std::vector<Field<Outer>> within(const std::string &prefix, const std::vector<Field<Inner>> &fields, Reach reach)
{
    std::vector<Field<Outer>> result;
    for (const Field<Inner> &inner : fields) {
        Field<Outer> outer;
        static_cast<FieldInfo &>(outer) = inner;
        outer.name = prefix + "." + inner.name;
        outer.get = [reach, get = inner.get](const Outer &o) -> std::optional<FieldValue> {
            const Inner *held = reach(o);
            return held ? get(*held) : std::nullopt;
        };
        outer.set = [reach, set = inner.set](Outer &o, const FieldValue &value) {
            if (Inner *held = reach(o))
                set(*held, value);
        };
        result.push_back(std::move(outer));
    }
    return result;
}

} // namespace faintline
