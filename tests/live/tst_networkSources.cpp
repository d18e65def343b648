#include "live/sources/RtlTcpSource.h"
#include "live/sources/UdpSource.h"
#include "support/test.h"

#include "base/Random.h"
#include "support/errors.h"

#include <atomic>
#include <thread>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr std::chrono::milliseconds patience{50};
constexpr double sentRate = 8000.0;

/// Sends datagrams to a port of this machine.
class Sender
{
public:
    explicit Sender(int port) : m_socket(::socket(AF_INET, SOCK_DGRAM, 0))
    {
        sockaddr_in to = {};
        to.sin_family = AF_INET;
        to.sin_port = htons(std::uint16_t(port));
        to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        if (::connect(m_socket, reinterpret_cast<const sockaddr *>(&to), sizeof to) != 0)
            qFatal("cannot send to this machine");
    }
    ~Sender() { ::close(m_socket); }
    void send(const QByteArray &bytes) const { (void)!::send(m_socket, bytes.data(), std::size_t(bytes.size()), 0); }

private:
    int m_socket;
};

/// A TCP server of this machine.
class Server
{
public:
    Server() : m_socket(::socket(AF_INET, SOCK_STREAM, 0))
    {
        const int yes = 1;
        ::setsockopt(m_socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        sockaddr_in at = {};
        at.sin_family = AF_INET;
        at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof at;
        if (::bind(m_socket, reinterpret_cast<const sockaddr *>(&at), size) != 0 || ::listen(m_socket, 4) != 0)
            qFatal("cannot serve on this machine");
        ::getsockname(m_socket, reinterpret_cast<sockaddr *>(&at), &size);
        m_port = ntohs(at.sin_port);
    }
    ~Server() { ::close(m_socket); }
    int accept() const { return ::accept(m_socket, nullptr, nullptr); }
    std::string address() const { return "127.0.0.1:" + std::to_string(m_port); }

private:
    int m_socket;
    int m_port = 0;
};

StreamFormat bytesFormat()
{
    return {parseSampleType("ru8", "test"), sentRate, 1, 0.0, {}};
}

/// A port that was free a moment ago.
int freePort()
{
    const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in at = {};
    at.sin_family = AF_INET;
    socklen_t size = sizeof at;
    (void)::bind(socket, reinterpret_cast<const sockaddr *>(&at), size);
    ::getsockname(socket, reinterpret_cast<sockaddr *>(&at), &size);
    ::close(socket);
    return ntohs(at.sin_port);
}

QByteArray numbered(std::uint64_t number, int bytes, bool isBigEndian, char content, int samples)
{
    QByteArray result;
    for (int i = 0; i < bytes; ++i)
        result.append(static_cast<char>(number >> 8 * (isBigEndian ? bytes - 1 - i : i)));
    return result + QByteArray(samples, content);
}

/// Everything in time: the bytes, and -1 for each lost sample.
std::vector<int> hearAll(SampleSource &source, int calls)
{
    std::vector<int> all;
    for (int call = 0; call < calls; ++call) {
        const Heard heard = source.hear(patience);
        all.insert(all.end(), std::size_t(heard.lostSamples), -1);
        for (const std::byte byte : heard.bytes)
            all.push_back(std::to_integer<int>(byte));
    }
    return all;
}

} // namespace

/// What the network loses is known to the sample where datagrams are numbered, and a server that goes away comes back.
class tst_networkSources : public QObject
{
    Q_OBJECT

private slots:
    void numberedDatagrams_data()
    {
        QTest::addColumn<QString>("numbers");
        QTest::addColumn<quint64>("first");
        QTest::newRow("u16be, across its end") << "u16be" << quint64(65'500);
        QTest::newRow("u16le") << "u16le" << quint64(7);
        QTest::newRow("u32le, across its end") << "u32le" << quint64(4'294'967'290u);
        QTest::newRow("u64be") << "u64be" << (quint64(1) << 40);
    }

    // Two hundred datagrams of different lengths, of which a third is lost and some come late or twice.
    void numberedDatagrams()
    {
        QFETCH(QString, numbers);
        QFETCH(quint64, first);
        const SequenceNumbers sequence = parseSequenceNumbers(numbers.toStdString());
        const int port = freePort();
        UdpSource source("127.0.0.1:" + std::to_string(port), bytesFormat(), sequence);
        const Sender sender(port);
        constexpr int samples = 100;
        Random random(3, first);
        std::vector<int> expected;
        const auto datagram = [&](int i) {
            return numbered(first + quint64(i), sequence.bytes, sequence.isBigEndian, static_cast<char>(1 + i % 200),
                            samples);
        };
        std::vector<int> heard;
        for (int i = 0; i < 200; ++i) {
            const bool isLost = i > 0 && i < 199 && random.uniform() < 0.33;
            expected.insert(expected.end(), samples, isLost ? -1 : 1 + i % 200);
            if (!isLost)
                sender.send(datagram(i));
            if (i % 17 == 5 && !isLost)
                sender.send(datagram(i)); // twice
            if (i % 20 == 19) {
                const std::vector<int> some = hearAll(source, 12);
                heard.insert(heard.end(), some.begin(), some.end());
            }
        }
        QVERIFY(std::count(expected.begin(), expected.end(), -1) > 3000);
        QCOMPARE(heard.size(), expected.size());
        QVERIFY(heard == expected);
    }

    void datagramsWithoutNumbers()
    {
        const int port = freePort();
        UdpSource source(std::to_string(port), {parseSampleType("ci16_le", "test"), sentRate, 1, 0.0, {}});
        const Sender sender(port);
        sender.send(QByteArray(400, 'a'));
        sender.send(QByteArray(403, 'b')); // three bytes that are no sample
        sender.send(QByteArray());
        const std::vector<int> heard = hearAll(source, 4);
        QCOMPARE(std::count(heard.begin(), heard.end(), 'a'), 400);
        QCOMPARE(std::count(heard.begin(), heard.end(), 'b'), 400);
    }

    void aSenderThatIsSilentForAWhile()
    {
        const int port = freePort();
        UdpSource source("127.0.0.1:" + std::to_string(port), bytesFormat(), parseSequenceNumbers("u32be"));
        const Sender sender(port);
        sender.send(numbered(1, 4, true, 'a', 80));
        QCOMPARE(hearAll(source, 2).size(), std::size_t(80));
        int gone = 0;
        QElapsedTimer timer;
        timer.start();
        while (timer.elapsed() < 1500)
            gone += source.hear(patience).incident == Heard::Incident::Gone;
        QCOMPARE(gone, 1);
        sender.send(numbered(500'000, 4, true, 'b', 80)); // numbers that the clock does not believe
        const qint64 elapsed = timer.elapsed();
        Heard back = source.hear(patience);
        QCOMPARE(back.incident, Heard::Incident::Back);
        QCOMPARE(back.bytes.size(), std::size_t(80));
        const double seconds = double(back.lostSamples) / sentRate;
        QVERIFY2(std::abs(seconds - double(elapsed) / 1000.0) < 0.3, qPrintable(QString::number(seconds)));
    }

    // Without a silence: no gap of a million years.
    void aSenderThatBeginsAnew()
    {
        const int port = freePort();
        UdpSource source("127.0.0.1:" + std::to_string(port), bytesFormat(), parseSequenceNumbers("u64be"));
        const Sender sender(port);
        constexpr std::uint64_t anew = std::uint64_t(1) << 62;
        for (const std::uint64_t number : {std::uint64_t(1), std::uint64_t(3), anew, anew + 2})
            sender.send(numbered(number, 8, true, 'a', 80));
        const std::vector<int> heard = hearAll(source, 4);
        QCOMPARE(heard.size(), std::size_t(6 * 80));
        QCOMPARE(std::count(heard.begin(), heard.end(), -1), 2 * 80);
    }

    void receiverIsSetAndHeard()
    {
        const Server server;
        QByteArray commands(25, '\0');
        std::jthread serving([&] {
            const int client = server.accept();
            (void)!::send(client, "RTL0\0\0\0\5\0\0\0\35", 12, 0);
            (void)!::recv(client, commands.data(), 25, MSG_WAITALL);
            (void)!::send(client, "abcde", 5, 0); // two samples and a half
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            (void)!::send(client, "f", 1, 0);
            std::this_thread::sleep_for(std::chrono::milliseconds(300));
            ::close(client);
        });
        RtlTcpSource source(server.address(), {100'000'000.0, 2'048'000.0, 29.7, -3});
        QCOMPARE(source.format().type.name(), std::string("cu8"));
        QCOMPARE(source.format().centreHz, 1e8);
        const std::vector<int> heard = hearAll(source, 6);
        QCOMPARE(heard, (std::vector<int>{'a', 'b', 'c', 'd', 'e', 'f'}));
        serving.join();
        QCOMPARE(commands.toHex(':'),
                 QByteArray("02:00:1f:40:00:05:ff:ff:ff:fd:01:05:f5:e1:00:03:00:00:00:01:04:00:00:01:29"));
    }

    void receiverThatComesBack()
    {
        const Server server;
        std::atomic<bool> isOver = false;
        std::jthread serving([&] {
            for (const char *said : {"first!", "second"}) {
                const int client = server.accept();
                (void)!::send(client, "RTL0\0\0\0\5\0\0\0\35", 12, 0);
                (void)!::send(client, said, 6, 0);
                std::this_thread::sleep_for(std::chrono::milliseconds(200));
                if (said[0] == 's')
                    while (!isOver)
                        std::this_thread::sleep_for(patience);
                ::close(client);
            }
        });
        RtlTcpSource source(server.address(), {1e8, 1000.0, {}, 0});
        std::vector<Heard::Incident> incidents;
        QByteArray bytes;
        Index lost = 0;
        QElapsedTimer timer;
        timer.start();
        while (bytes.size() < 12 && timer.elapsed() < 20'000) {
            const Heard heard = source.hear(patience);
            for (const std::byte byte : heard.bytes)
                bytes.append(static_cast<char>(byte));
            if (heard.incident != Heard::Incident::None)
                incidents.push_back(heard.incident);
            lost += heard.lostSamples;
        }
        const double seconds = double(timer.elapsed()) / 1000.0;
        isOver = true;
        QCOMPARE(bytes, QByteArray("first!second"));
        QCOMPARE(incidents, (std::vector{Heard::Incident::Gone, Heard::Incident::Back}));
        QVERIFY2(lost > 500 && double(lost) / 1000.0 < seconds, qPrintable(QString::number(lost)));
    }

    void mistakes()
    {
        QVERIFY(contains(errorOf([] { parseSequenceNumbers("u8"); }), "u16le"));
        QVERIFY(contains(errorOf([] { UdpSource("no-such-address.invalid:9", bytesFormat()); }), "--udp"));
        QVERIFY(contains(errorOf([] { UdpSource("127.0.0.1:port", bytesFormat()); }), "expected PORT"));
        QVERIFY(contains(errorOf([] { UdpSource("99999", bytesFormat()); }), "1 … 65535"));
        QVERIFY(contains(errorOf([] { RtlTcpSource("127.0.0.1:0", {1e8, 1e6, {}, 0}); }), "1 … 65535"));
        const Server server;
        std::jthread serving([&] {
            const int client = server.accept();
            (void)!::send(client, "HTTP/1.1 400", 12, 0);
            ::close(client);
        });
        QVERIFY(contains(errorOf([&] {
                             RtlTcpSource(server.address(), {1e8, 1e6, {}, 0});
                         }),
                         "does not identify itself"));
        QVERIFY(contains(errorOf([] { RtlTcpSource("127.0.0.1:1", {1e8, 1e6, {}, 0}); }), "no receiver answers"));
    }
};

FAINTLINE_TEST(tst_networkSources)
#include "tst_networkSources.moc"
